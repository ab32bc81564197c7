// SPDX-License-Identifier: MIT
#include "harness/session/watchdog.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <vector>

#include "harness/base/interrupt.h"

namespace bvhbench {
namespace {

using namespace std::chrono_literals;

// A line with the run's id, then lines of a cell, a tab, and why it was given up.
constexpr const char* variable = "BVHBENCH_GOES_ON";
constexpr long over = -1;

// Not SIGFPE: PoCL has a handler for that.
constexpr std::array crashes = {SIGSEGV, SIGBUS, SIGILL, SIGABRT};
std::array<void (*)(int), crashes.size()> before = {};
std::atomic<const Watchdog*> watching = nullptr;  // a signal handler has no other way to it

long now_ms()
{
    return std::chrono::duration_cast<std::chrono::milliseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// This process's command line, word by word.
std::vector<std::string> own_words()
{
    std::ifstream file("/proc/self/cmdline", std::ios::binary);
    std::vector<std::string> words;
    for (std::string word; std::getline(file, word, '\0');)
        words.push_back(word);
    return words;
}

/// Descriptors would outlive the program, and with them what a driver holds.
void close_on_exec()
{
    for (int file = 3, most = static_cast<int>(sysconf(_SC_OPEN_MAX)); file < most; ++file)
        fcntl(file, F_SETFD, FD_CLOEXEC);
}

std::string spelled(double seconds)
{
    char text[32];
    std::snprintf(text, sizeof text, "%g", seconds);
    return text;
}

[[noreturn]] void say_and_end(const std::string& sentence)
{
    std::fprintf(stderr, "bvhbench: %s\n", sentence.c_str());
    _exit(3);
}

[[noreturn]] void begin_anew()
{
    std::vector<std::string> words = own_words();
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    close_on_exec();
    execv("/proc/self/exe", argv.data());
    say_and_end("cannot begin anew after a build or query that did not end");
}

}  // namespace

Watchdog::Watchdog(double limit_s) : limit_s_(limit_s)
{
    if (const char* text = std::getenv(variable)) {
        std::istringstream lines(text);
        std::getline(lines, run_id_);
        for (std::string cell, why; std::getline(lines, cell, '\t') && std::getline(lines, why);)
            given_up_[cell] = why;
    }
    if (limit_s_ <= 0)
        return;
    thread_ = std::thread([this] { look(); });
    watching = this;
    for (std::size_t i = 0; i < crashes.size(); ++i)
        before[i] = std::signal(crashes[i], crashed);
}

Watchdog::~Watchdog()
{
    if (limit_s_ > 0) {
        for (std::size_t i = 0; i < crashes.size(); ++i)
            std::signal(crashes[i], before[i]);
        watching = nullptr;
    }
    {
        const std::lock_guard lock(mutex_);
        stops_ = true;
    }
    stop_.notify_all();
    if (thread_.joinable())
        thread_.join();
}

std::string Watchdog::given_up(const std::string& cell) const
{
    const auto found = given_up_.find(cell);
    return found == given_up_.end() ? std::string() : found->second;
}

void Watchdog::keep_by(std::string run_id, std::function<void()> keep)
{
    keeps_ = std::move(run_id);
    keep_ = std::move(keep);
}

Watchdog::Watch::Watch(Watchdog& dog) : dog_(dog)
{
    if (dog.limit_s_ <= 0 || dog.until_ != 0)
        return;
    until_ = now_ms() + static_cast<long>(dog.limit_s_ * 1000);
    dog.until_ = until_;
}

Watchdog::Watch::~Watch()
{
    if (until_ == 0)
        return;
    long expected = until_;
    if (!dog_.until_.compare_exchange_strong(expected, 0))
        for (;;)  // it was over a moment ago: the program is about to begin anew
            pause();
}

/// Looks up a few times a second, so that who is watched wakes nobody.
void Watchdog::look()
{
    std::unique_lock lock(mutex_);
    while (!stop_.wait_for(lock, 100ms, [this] { return stops_; })) {
        long until = until_;
        if (until > 0 && now_ms() > until && until_.compare_exchange_strong(until, over))
            end("took longer than " + spelled(limit_s_) +
                " s and was ended; --time-limit gives a build or query more");
    }
}

/// Little may be done in a handler of signals, and this does more: whoever crashed may hold the heap. Then the alarm ends
/// the process, and what is in the file stays.
void Watchdog::crashed(int signal)
{
    for (const int each : crashes)
        std::signal(each, SIG_DFL);
    alarm(5);
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_UNBLOCK, &all, nullptr);
    const char* cache = std::getenv("POCL_CACHE_DIR");
    watching.load()->end("crashed (signal " + std::to_string(signal) +
                         "); damaged kernels in the OpenCL driver's cache can be why" +
                         (cache != nullptr ? std::string(": remove ") + cache : ""));
}

void Watchdog::end(const std::string& why) const
{
    if (is_interrupted())
        for (;;)  // until that has ended the process
            pause();
    const std::string* const cell = cell_;
    if (cell == nullptr || !keep_)
        say_and_end("what was to be done " + why);
    try {
        keep_();
    } catch (const std::exception& error) {
        say_and_end(error.what());
    }
    std::string text = keeps_ + '\n';
    for (const auto& [earlier, reason] : given_up_)
        text += earlier + '\t' + reason + '\n';
    text += *cell + '\t' + why + '\n';
    setenv(variable, text.c_str(), 1);
    alarm(0);
    begin_anew();
}

}  // namespace bvhbench
