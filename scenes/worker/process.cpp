// SPDX-License-Identifier: MIT
#include "scenes/worker/process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <system_error>

#include "geometry/error.h"

namespace bvhbench {
namespace {

using Clock = std::chrono::steady_clock;

/// Both ends of a pipe, closed with the object and in spawned processes.
class Pipe {
public:
    Pipe()
    {
        if (pipe2(ends_, O_CLOEXEC) != 0)
            throw Unavailable("no pipe to a reader process: " +
                              std::system_category().message(errno));
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    ~Pipe()
    {
        close(ends_[0]);
        close_writer();
    }

    int reader() const { return ends_[0]; }
    int writer() const { return ends_[1]; }
    void close_writer()
    {
        if (ends_[1] >= 0)
            close(ends_[1]);
        ends_[1] = -1;
    }

private:
    int ends_[2] = {-1, -1};
};

/// posix_spawn's list of what happens to file descriptors in the new process.
class Redirections {
public:
    explicit Redirections(int output)
    {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_addopen(&actions_, 0, "/dev/null", O_RDONLY, 0);
        posix_spawn_file_actions_adddup2(&actions_, output, 1);
        posix_spawn_file_actions_addopen(&actions_, 2, "/dev/null", O_WRONLY, 0);
    }
    Redirections(const Redirections&) = delete;
    Redirections& operator=(const Redirections&) = delete;
    ~Redirections() { posix_spawn_file_actions_destroy(&actions_); }
    const posix_spawn_file_actions_t* get() const { return &actions_; }

private:
    posix_spawn_file_actions_t actions_;
};

std::vector<char*> pointers(std::vector<std::string>& words)
{
    std::vector<char*> result;
    for (std::string& word : words)
        result.push_back(word.data());
    result.push_back(nullptr);
    return result;
}

pid_t spawn(std::vector<std::string> command, int output, const std::string& extra)
{
    std::vector<std::string> environment;
    for (char** variable = environ; *variable != nullptr; ++variable)
        environment.emplace_back(*variable);
    environment.push_back(extra);
    const Redirections redirections(output);
    pid_t process = 0;
    const int error = posix_spawn(&process, command[0].c_str(), redirections.get(), nullptr,
                                  pointers(command).data(), pointers(environment).data());
    if (error != 0)
        throw Unavailable("no reader process: " + command[0] + ": " +
                          std::system_category().message(error));
    return process;
}

/// Reads to the end of the pipe. False if `until` comes first.
bool drain(int reader, Clock::time_point until, std::string& output)
{
    std::vector<char> buffer(1 << 20);
    while (true) {
        const Clock::time_point now = Clock::now();
        if (now >= until)  // whatever has come in the meantime
            return false;
        const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(until - now).count();
        pollfd waiting{reader, POLLIN, 0};
        const int ready = poll(&waiting, 1, static_cast<int>(std::clamp<long>(left, 0, 1 << 30)));
        if (ready < 0 && errno == EINTR)
            continue;
        if (ready <= 0)
            return false;
        const ssize_t count = read(reader, buffer.data(), buffer.size());
        if (count <= 0)
            return true;
        output.append(buffer.data(), static_cast<std::size_t>(count));
    }
}

}  // namespace

ProcessEnd run_process(const std::vector<std::string>& command, double time_limit_s,
                       const std::string& extra_environment)
{
    const auto until =
        Clock::now() + std::chrono::duration_cast<Clock::duration>(
                           std::chrono::duration<double>(std::min(time_limit_s, 1e6)));
    Pipe pipe;
    const pid_t process = spawn(command, pipe.writer(), extra_environment);
    pipe.close_writer();
    ProcessEnd end;
    const bool finished = drain(pipe.reader(), until, end.output);
    if (!finished)
        kill(process, SIGKILL);
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    if (!finished)
        end.how = ProcessEnd::How::timed_out;
    else if (WIFSIGNALED(status))
        end.how = ProcessEnd::How::signalled;
    end.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
    return end;
}

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

}  // namespace bvhbench
