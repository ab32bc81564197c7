// SPDX-License-Identifier: MIT
#include "process/child.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "geometry/error.h"

namespace bvhbench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* parent = "BVHBENCH_PARENT";

std::vector<char*> pointers(std::vector<std::string>& words)
{
    std::vector<char*> result;
    for (std::string& word : words)
        result.push_back(word.data());
    result.push_back(nullptr);
    return result;
}

/// Returns `variables`, followed by this process's variables whose names do not occur in them: the first of equal names counts.
std::vector<std::string> environment_under(std::vector<std::string> variables)
{
    const auto name = [](std::string_view variable) {
        return variable.substr(0, variable.find('='));
    };
    const std::size_t given = variables.size();
    for (char** own = environ; *own != nullptr; ++own)
        if (std::none_of(variables.begin(), variables.begin() + static_cast<std::ptrdiff_t>(given),
                         [&](const std::string& other) { return name(other) == name(*own); }))
            variables.emplace_back(*own);
    return variables;
}

/// Makes this process end with its parent, which was `process`.
void end_with(pid_t process)
{
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != process)  // the parent ended before prctl
        _exit(128 + SIGKILL);
}

/// Reads to the end of the pipe. False if the time `until` comes first.
bool drain(Child& child, Clock::time_point until)
{
    while (true) {
        const Clock::time_point now = Clock::now();
        if (now >= until)  // also if output keeps arriving
            return false;
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(until - now).count();
        pollfd waiting{child.reader(), POLLIN, 0};
        const int ready = poll(&waiting, 1, static_cast<int>(std::clamp<long>(left, 0, 1 << 30)));
        if (ready < 0 && errno == EINTR)
            continue;
        if (ready <= 0)
            return false;
        if (!child.take())
            return true;
    }
}

}  // namespace

std::string spelled(const ProcessEnd& end, double time_limit_s)
{
    if (end.how == ProcessEnd::How::signalled)
        return "crashed (signal " + std::to_string(end.code) + ")";
    if (end.how == ProcessEnd::How::exited)
        return "ended with exit code " + std::to_string(end.code);
    char limit[32];
    std::snprintf(limit, sizeof limit, "%g", time_limit_s);
    return std::string("took longer than ") + limit + " s";
}

Child::Child(Start start)
{
    std::vector<std::string> environment = environment_under(std::move(start.environment));
    const std::vector<char*> words = pointers(start.words), variables = pointers(environment);
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        throw Unavailable("no pipe to a process of its own: " +
                          std::system_category().message(errno));
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    if (start.input >= 0)
        posix_spawn_file_actions_adddup2(&files, start.input, STDIN_FILENO);
    else
        posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    for (const auto& [file, where] :
         {std::pair(STDOUT_FILENO, start.output), {STDERR_FILENO, start.errors}})
        if (where == Stream::captured)
            posix_spawn_file_actions_adddup2(&files, ends[1], file);
        else if (where == Stream::dropped)
            posix_spawn_file_actions_addopen(&files, file, "/dev/null", O_WRONLY, 0);
    if (start.errors_to >= 0)
        posix_spawn_file_actions_adddup2(&files, start.errors_to, STDERR_FILENO);
    const int error = posix_spawnp(&process_, start.path.c_str(), &files, nullptr, words.data(),
                                   variables.data());
    posix_spawn_file_actions_destroy(&files);
    close(ends[1]);
    reader_ = ends[0];
    if (error == 0)
        return;
    close(reader_);
    throw Unavailable(start.path + " cannot be started: " + std::system_category().message(error));
}

std::unique_ptr<Child> Child::forked()
{
    const pid_t self = getpid(), process = fork();
    if (process < 0)
        throw Unavailable("out of host memory: there is no room for another process");
    if (process > 0)
        return std::unique_ptr<Child>(new Child(process));
    end_with(self);
    leave_no_core();
    return nullptr;
}

Child::~Child()
{
    if (process_ > 0) {
        send(SIGKILL);
        wait();
    }
    if (reader_ >= 0)
        close(reader_);
}

bool Child::take()
{
    std::array<char, std::size_t{1} << 16> more;
    const ssize_t count = read(reader_, more.data(), more.size());
    if (count > 0)
        text_.append(more.data(), static_cast<std::size_t>(count));
    return count > 0 || (count < 0 && errno == EINTR);
}

void Child::send(int signal) const
{
    if (process_ > 0)
        kill(process_, signal);
}

ProcessEnd Child::wait()
{
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    return end_of(status);
}

std::optional<ProcessEnd> Child::end()
{
    int status = 0;
    if (waitpid(process_, &status, WNOHANG) != process_)
        return std::nullopt;
    return end_of(status);
}

ProcessEnd Child::end_of(int status)
{
    process_ = 0;
    if (WIFSIGNALED(status))
        return {ProcessEnd::How::signalled, WTERMSIG(status), std::move(text_)};
    return {ProcessEnd::How::exited, WEXITSTATUS(status), std::move(text_)};
}

ProcessEnd run_process(const std::vector<std::string>& command, double time_limit_s,
                       const std::string& extra_environment)
{
    const auto until =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(
                           std::chrono::duration<double>(std::min(time_limit_s, 1e6)));
    Child child({.path = command.front(),
                 .words = command,
                 .environment = {extra_environment, parent_variable()}});
    const bool finished = drain(child, until);
    if (!finished)
        child.send(SIGKILL);
    ProcessEnd end = child.wait();
    if (!finished)
        end.how = ProcessEnd::How::timed_out;
    return end;
}

std::string parent_variable() { return std::string(parent) + '=' + std::to_string(getpid()); }

void end_with_parent()
{
    const char* const wanted = std::getenv(parent);
    if (wanted == nullptr)
        return;
    const long process = std::strtol(wanted, nullptr, 10);
    unsetenv(parent);  // not meant for this process's children
    end_with(static_cast<pid_t>(process));
}

void leave_no_core()
{
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
}

}  // namespace bvhbench
