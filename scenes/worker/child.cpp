// SPDX-License-Identifier: MIT
#include "scenes/worker/child.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <functional>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "geometry/error.h"

namespace bvhbench {
namespace {

/// posix_spawn's list of what happens to file descriptors in the new process.
class Redirections {
public:
    Redirections()
    {
        posix_spawn_file_actions_init(&actions_);
        posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    }
    Redirections(const Redirections&) = delete;
    Redirections& operator=(const Redirections&) = delete;
    ~Redirections() { posix_spawn_file_actions_destroy(&actions_); }

    void stream(int file, Child::Stream where, int writer)
    {
        if (where == Child::Stream::captured)
            posix_spawn_file_actions_adddup2(&actions_, writer, file);
        else if (where == Child::Stream::dropped)
            posix_spawn_file_actions_addopen(&actions_, file, "/dev/null", O_WRONLY, 0);
    }
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

/// `variables`, and those of this process's own that none of them names: of two of one name the first counts.
std::vector<std::string> environment_under(std::vector<std::string> variables)
{
    std::set<std::string, std::less<>> named;
    for (const std::string& variable : variables)
        named.insert(variable.substr(0, variable.find('=')));
    for (char** own = environ; *own != nullptr; ++own) {
        const std::string_view variable = *own;
        if (!named.contains(variable.substr(0, variable.find('='))))
            variables.emplace_back(variable);
    }
    return variables;
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
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
        throw Unavailable("no pipe to a process of its own: " +
                          std::system_category().message(errno));
    Redirections redirections;
    redirections.stream(STDOUT_FILENO, start.output, ends[1]);
    redirections.stream(STDERR_FILENO, start.errors, ends[1]);
    const int error = posix_spawnp(&process_, start.path.c_str(), redirections.get(), nullptr,
                                   pointers(start.words).data(), pointers(environment).data());
    close(ends[1]);
    reader_ = ends[0];
    if (error == 0)
        return;
    close(std::exchange(reader_, -1));
    throw Unavailable(start.path + " cannot be started: " + std::system_category().message(error));
}

Child::Child(Child&& other) noexcept
    : process_(std::exchange(other.process_, 0))
    , reader_(std::exchange(other.reader_, -1))
    , text_(std::move(other.text_))
    , most_bytes_(other.most_bytes_)
{}

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
    if (count < 0 && errno == EINTR)
        return true;
    if (count <= 0)
        return false;
    text_.append(more.data(), static_cast<std::size_t>(count));
    if (most_bytes_ > 0 && text_.size() > most_bytes_)
        text_.erase(0, text_.size() - most_bytes_);
    return true;
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
    process_ = 0;
    ProcessEnd end;
    end.output = std::move(text_);
    if (WIFSIGNALED(status))
        end.how = ProcessEnd::How::signalled;
    end.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
    return end;
}

}  // namespace bvhbench
