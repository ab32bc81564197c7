// SPDX-License-Identifier: MIT
//
// Child processes: other programs, this program itself for tasks that may crash or use too much memory, and forks of it.
#pragma once

#include <sys/types.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace bvhbench {

/// How a process ended, and its output.
struct ProcessEnd {
    enum class How { exited, signalled, timed_out };
    How how = How::exited;
    int code = 0;  ///< exit code or signal
    std::string output;
};

/// Returns "crashed (signal 11)", "took longer than 120 s" or "ended with exit code 1".
std::string spelled(const ProcessEnd& end, double time_limit_s);

/// A child process. The destructor ends it.
class Child {
public:
    enum class Stream { captured, inherited, dropped };

    /// Start parameters. `words` is argv; `environment`, each "NAME=value", overrides this process's environment.
    struct Start {
        std::string path;  ///< searched in PATH if it contains no slash
        std::vector<std::string> words;
        std::vector<std::string> environment = {};
        Stream output = Stream::captured, errors = Stream::dropped;
        int input = -1;      ///< file descriptor that becomes standard input; -1: that is empty
        int errors_to = -1;  ///< file descriptor that becomes standard error, in place of `errors`
    };

    /// Starts the process. Throws Unavailable if it cannot be started.
    explicit Child(Start start);
    ~Child();

    /// Forks this process, which must have a single thread. Returns the child; in the child itself, which ends with this process and
    /// leaves no core file, null. Throws Unavailable if there is no room for another process.
    static std::unique_ptr<Child> forked();
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    pid_t process() const { return process_; }

    /// Returns a file descriptor for poll that becomes readable when take() can read more.
    int reader() const { return reader_; }

    /// Reads available output of the captured streams and keeps it for wait(). False at the end of the output.
    bool take();

    void send(int signal) const;

    /// Waits until the process has ended.
    ProcessEnd wait();

    /// Returns how the process ended; nothing if it has not.
    std::optional<ProcessEnd> end();

private:
    explicit Child(pid_t process) : process_(process) {}
    ProcessEnd end_of(int status);

    pid_t process_ = 0;
    int reader_ = -1;
    std::string text_;
};

/// Runs `command`, whose first word is a path, with standard error discarded. Kills it after `time_limit_s` or when this
/// process ends. `extra_environment` is "NAME=value". Throws Unavailable if the process cannot be started.
ProcessEnd run_process(const std::vector<std::string>& command, double time_limit_s,
                       const std::string& extra_environment);

/// Returns the variable, "NAME=value", that makes a child of this program end with this process.
std::string parent_variable();

/// Makes this process end with its parent, if the parent asked for it. Called at the beginning of main.
void end_with_parent();

/// Makes a crash of this process leave no core file.
void leave_no_core();

}  // namespace bvhbench
