// SPDX-License-Identifier: MIT
#include "harness/base/interrupt.h"

#include <semaphore.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "harness/base/failure.h"

namespace bvhbench {

/// How a signal ends the process. Global, because a signal handler has no other way to leave word.
class SignalEnd {
public:
    void begin()
    {
        sem_init(&woken_, 0, 0);
        try {
            std::thread([this] { wait(); }).detach();
        } catch (const std::system_error&) {
            return;  // no room for a thread: signals end the process as they end any other
        }
        struct sigaction action = {};
        action.sa_handler = remember;
        action.sa_flags = SA_RESTART;
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
            struct sigaction before = {};
            sigaction(signal, nullptr, &before);
            if (signal != SIGHUP || before.sa_handler != SIG_IGN)
                sigaction(signal, &action, nullptr);
        }
    }

    void add(const AtSignal& one)
    {
        const std::lock_guard lock(mutex_);
        all_.push_back(&one);
    }

    void remove(const AtSignal& one)
    {
        const std::lock_guard lock(mutex_);
        std::erase(all_, &one);
    }

    void defer() { ++deferrals_; }

    void defer_no_more()
    {
        if (--deferrals_ == 0 && is_interrupted())
            end();
    }

    bool is_interrupted() const { return received_ != 0; }

private:
    static void remember(int signal);

    [[noreturn]] void wait()
    {
        for (;;) {
            while (sem_wait(&woken_) != 0) {
            }
            if (deferrals_ == 0)
                end();
        }
    }

    /// Whoever waits for the mutex waits until the process is gone.
    [[noreturn]] void end()
    {
        mutex_.lock();
        std::vector<std::string> clauses;
        for (const AtSignal* one : all_) {
            std::string clause = one->kept_;
            if (const std::string failure = reason_of_failure(one->work_); !failure.empty())
                clause = failure;
            if (!clause.empty() &&
                std::find(clauses.begin(), clauses.end(), clause) == clauses.end())
                clauses.push_back(clause);
        }
        std::string sentence = "bvhbench: stopped";
        for (const std::string& clause : clauses)
            sentence += "; " + clause;
        if (isatty(STDERR_FILENO) == 1)
            std::fputs("\r\033[K", stderr);  // what shows progress is on that line
        std::cerr << sentence + '\n' << std::flush;
        _exit(128 + received_);
    }

    sem_t woken_ = {};
    std::atomic<int> received_ = 0;
    std::atomic<int> deferrals_ = 0;
    std::mutex mutex_;
    std::vector<const AtSignal*> all_;
};

namespace {

/// Never destroyed: its thread outlives main.
SignalEnd& signal_end()
{
    static SignalEnd& only = *new SignalEnd;
    return only;
}

}  // namespace

void SignalEnd::remember(int signal)
{
    SignalEnd& only = signal_end();
    if (only.received_.exchange(signal) != 0)
        _exit(128 + signal);
    sem_post(&only.woken_);
}

void end_on_signals() { signal_end().begin(); }

bool is_interrupted() { return signal_end().is_interrupted(); }

AtSignal::AtSignal(std::function<void()> work, std::string kept)
    : work_(std::move(work)), kept_(std::move(kept))
{
    signal_end().add(*this);
}

AtSignal::~AtSignal() { signal_end().remove(*this); }

DeferSignals::DeferSignals() { signal_end().defer(); }

DeferSignals::~DeferSignals() { signal_end().defer_no_more(); }

}  // namespace bvhbench
