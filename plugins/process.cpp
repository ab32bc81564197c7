// SPDX-License-Identifier: MIT
#include "plugins/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "geometry/error.h"
#include "plugins/worker.h"

namespace bvhbench::outside {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int look_ms = 100;  ///< between two looks at the resident memory
constexpr std::size_t longest_reply = std::size_t{1} << 20;
constexpr std::size_t kept_errors = 4096;       ///< of standard error, from its end
constexpr int leaving_ms = 2000;                ///< given to a process that is about to end
constexpr std::chrono::seconds family_look{1};  ///< between two looks at all that it started

std::string seconds_text(double seconds)
{
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%g s", seconds);
    return text.data();
}

/// Waits until the process has ended, which is left to be told of. False if it has not after leaving_ms.
bool has_ended(pid_t process)
{
    for (int waited = 0; waited < leaving_ms; waited += 2) {
        siginfo_t facts = {};
        if (waitid(P_PID, static_cast<id_t>(process), &facts, WEXITED | WNOHANG | WNOWAIT) == 0 &&
            facts.si_pid == process)
            return true;
        poll(nullptr, 0, 2);
    }
    return false;
}

bool read_from(int file, std::string& text)
{
    std::array<char, std::size_t{1} << 16> more;
    const ssize_t count = read(file, more.data(), more.size());
    if (count > 0)
        text.append(more.data(), static_cast<std::size_t>(count));
    return count > 0 || (count < 0 && errno == EINTR);
}

/// Two ends of a channel, closed with this object unless taken.
struct Ends {
    std::array<int, 2> files{-1, -1};
    ~Ends()
    {
        for (const int file : files)
            if (file >= 0)
                close(file);
    }
    int take(std::size_t which) { return std::exchange(files[which], -1); }
};

}  // namespace

Process::Process(const Library& library, const Limits& limits) : library_(library), limits_(limits)
{
    Ends input, errors;
    // A socket, because writing to one whose reader has ended raises no signal with MSG_NOSIGNAL.
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, input.files.data()) != 0 ||
        pipe2(errors.files.data(), O_CLOEXEC) != 0)
        fail("there is no channel to it: " + std::system_category().message(errno));
    child_ =
        std::make_unique<Child>(Child::Start{.path = "/proc/self/exe",
                                             .words = worker_words(library),
                                             .environment = {parent_variable(), family_.variable()},
                                             .input = input.files[1],
                                             .errors_to = errors.files[1]});
    to_ = input.take(0);
    errors_ = errors.take(0);
    fcntl(errors_, F_SETFL, O_NONBLOCK);
}

Process::~Process()
{
    constexpr std::string_view quit = "{\"call\":\"quit\"}\n";
    if (child_ != nullptr && send(to_, quit.data(), quit.size(), MSG_NOSIGNAL) > 0)
        has_ended(child_->process());  // else it is killed
    end_all();
    for (const int file : {to_, errors_})
        if (file >= 0)
            close(file);
}

/// Ends the process and all that it started.
void Process::end_all()
{
    if (child_ == nullptr)
        return;
    child_.reset();
    family_.end({});
}

void Process::fail(const std::string& what)
{
    end_all();
    std::string words = last_words(last_errors_);
    throw Unavailable(std::filesystem::path(library_.file).filename().string() +
                      (call_.empty() ? "" : " in `" + call_ + "`") + ": " + what +
                      (words.empty() ? "" : "; its last words: " + words));
}

/// Says how the process ended.
void Process::fail_at_end()
{
    if (!has_ended(child_->process()))
        fail("it closed its standard output");
    keep_errors();
    const ProcessEnd end = child_->wait();
    fail("it " + spelled(end, 0));
}

/// Reads what there is of its standard error, and keeps the end.
void Process::keep_errors()
{
    while (errors_ >= 0 && read_from(errors_, last_errors_))
        if (last_errors_.size() > kept_errors)
            last_errors_.erase(0, last_errors_.size() - kept_errors);
}

/// Throws if the process takes too much memory, or, at most once a second, if it does with all that it started.
void Process::check_resident()
{
    if (limits_.host_bytes == 0)
        return;
    std::uint64_t taken = resident_bytes(child_->process());
    if (const auto now = Clock::now(); now - family_looked_ > family_look) {
        family_looked_ = now;
        taken = 0;
        for (const pid_t process : family_.processes())
            taken += resident_bytes(process);
    }
    if (taken > limits_.host_bytes)
        fail("out of host memory: it takes " + std::to_string(taken) + " bytes, and " +
             std::to_string(limits_.host_bytes) + " are allowed");
}

/// Returns the next line of its standard output, for which it has limits_.call_s.
std::string Process::next_line()
{
    const auto start = Clock::now();
    while (true) {
        if (const std::size_t end = replies_.find('\n'); end != replies_.npos) {
            std::string line = replies_.substr(0, end);
            replies_.erase(0, end + 1);
            return line;
        }
        if (replies_.size() > longest_reply)
            fail("its reply is malformed: it has more than " + std::to_string(longest_reply) +
                 " bytes");
        const std::chrono::duration<double> elapsed = Clock::now() - start;
        if (limits_.call_s > 0 && elapsed.count() > limits_.call_s)
            fail("it took longer than " + seconds_text(limits_.call_s) +
                 " and was ended; --time-limit gives a call more");
        std::array<pollfd, 2> waiting{pollfd{child_->reader(), POLLIN, 0},
                                      pollfd{errors_, POLLIN, 0}};
        const int ready = poll(waiting.data(), waiting.size(), look_ms);
        if (ready == 0)
            check_resident();
        if (ready <= 0)
            continue;
        if ((waiting[1].revents & POLLIN) != 0)
            keep_errors();
        else if (waiting[1].revents != 0)
            close(std::exchange(errors_, -1));  // it closed its standard error
        if (waiting[0].revents != 0 && !read_from(child_->reader(), replies_))
            fail_at_end();
    }
}

Json Process::ask(const Json& request)
{
    if (child_ == nullptr)
        fail("it was ended before");
    call_ = request.at("call").get<std::string>();
    std::string text = request.dump() + '\n';
    const auto start = Clock::now();
    for (std::string_view left = text; !left.empty();) {
        const ssize_t count = send(to_, left.data(), left.size(), MSG_NOSIGNAL);
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            fail_at_end();
        left.remove_prefix(static_cast<std::size_t>(count));
    }
    const std::string line = next_line();
    wall_ns_ = std::chrono::nanoseconds(Clock::now() - start).count();
    check_resident();
    return reading([&] { return parsed_reply(line); });
}

Library described(const std::string& file, bool is_program, const Limits& limits)
{
    Library library;
    library.is_program = is_program;
    if (!std::filesystem::is_regular_file(file))
        throw Unavailable("there is no file '" + file + "'");
    library.file = std::filesystem::absolute(file).lexically_normal().string();
    Process process(library, limits);
    const Json reply = process.ask({{"call", "hello"}, {"protocol", protocol}});
    process.reading([&] {
        describe(library, reply);
        return 0;
    });
    return library;
}

}  // namespace bvhbench::outside
