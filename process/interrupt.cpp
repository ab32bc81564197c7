// SPDX-License-Identifier: MIT
#include "process/interrupt.h"

#include <semaphore.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <mutex>
#include <new>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace bvhbench {
namespace {

using Clock = std::chrono::steady_clock;

/// Signals this close together count as one: the process group and the parent (process/watchdog.h) may each deliver it.
constexpr auto as_one = std::chrono::milliseconds(200);

// Global, because a signal handler can pass information in no other way.
sem_t woken;
std::atomic<int> received = 0;
std::atomic<Clock::rep> received_at = 0;

// Never destroyed, because the signal thread outlives main.
std::mutex& mutex = *new std::mutex;
std::vector<const AtSignal*>& actions = *new std::vector<const AtSignal*>;

void remember(int signal)
{
    const Clock::rep now = Clock::now().time_since_epoch().count();
    if (received.exchange(signal) == 0) {
        received_at = now;
        sem_post(&woken);
    } else if (Clock::duration(now - received_at) > as_one) {
        _exit(128 + signal);
    }
}

/// Runs the work of all AtSignals, prints the sentence and exits. The mutex stays locked, so that any other thread that needs
/// it blocks until the process has ended.
[[noreturn]] void end()
{
    mutex.lock();
    std::vector<std::string> clauses;
    for (const AtSignal* one : actions) {
        std::string clause = one->kept;
        try {
            one->work();
        } catch (const std::bad_alloc&) {
            clause = "out of host memory";
        } catch (const std::exception& error) {
            clause = error.what();
        }
        if (!clause.empty() && std::find(clauses.begin(), clauses.end(), clause) == clauses.end())
            clauses.push_back(clause);
    }
    std::string sentence = "bvhbench: stopped";
    for (const std::string& clause : clauses)
        sentence += "; " + clause;
    if (isatty(STDERR_FILENO) == 1)
        std::fputs("\r\033[K", stderr);  // clears a line of progress
    std::cerr << sentence + '\n' << std::flush;
    _exit(128 + received);
}

}  // namespace

std::vector<int> ending_signals()
{
    struct sigaction hang_up = {};
    sigaction(SIGHUP, nullptr, &hang_up);
    if (hang_up.sa_handler == SIG_IGN)
        return {SIGINT, SIGTERM};
    return {SIGINT, SIGTERM, SIGHUP};
}

void end_on_signals()
{
    static bool has_begun = false;
    if (std::exchange(has_begun, true))
        return;
    sem_init(&woken, 0, 0);
    try {
        std::thread([] {
            while (sem_wait(&woken) != 0) {
            }
            end();
        }).detach();
    } catch (const std::system_error&) {
        return;  // no memory for a thread: signals keep their default action
    }
    struct sigaction action = {};
    action.sa_handler = remember;
    action.sa_flags = SA_RESTART;
    for (const int signal : ending_signals())
        sigaction(signal, &action, nullptr);
}

void ignore_signals()
{
    for (const int signal : ending_signals())
        std::signal(signal, SIG_IGN);
    while (received != 0)
        pause();  // the sleeping thread has woken, and ends this process
}

AtSignal::AtSignal(std::function<void()> done, std::string said)
    : work(std::move(done)), kept(std::move(said))
{
    const std::lock_guard lock(mutex);
    actions.push_back(this);
}

AtSignal::AtSignal(const std::function<void()>& begin, std::function<void()> done)
    : work(std::move(done))
{
    const std::lock_guard lock(mutex);
    begin();
    actions.push_back(this);
}

AtSignal::~AtSignal()
{
    const std::lock_guard lock(mutex);
    std::erase(actions, this);
}

}  // namespace bvhbench
