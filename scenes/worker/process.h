// SPDX-License-Identifier: MIT
//
// Processes that are started from here: Python, and this program itself for what may crash or take too much.
#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>
#include <vector>

namespace bvhbench {

/// How a process ended and what it wrote.
struct ProcessEnd {
    enum class How { exited, signalled, timed_out };
    How how = How::exited;
    int code = 0;  ///< exit code or signal
    std::string output;
};

/// "crashed (signal 11)", "took longer than 120 s" or "ended with exit code 1".
std::string spelled(const ProcessEnd& end, double time_limit_s);

/// A process that was started from here. It does not outlive the object.
class Child {
public:
    enum class Stream { captured, inherited, dropped };

    /// What it is started with. `words` are its argv; `environment`, each "NAME=value", comes on top of this process's own.
    struct Start {
        std::string path;  ///< looked for in PATH if there is no slash in it
        std::vector<std::string> words;
        std::vector<std::string> environment = {};
        Stream output = Stream::captured, errors = Stream::dropped;
    };

    /// With nothing on standard input. Throws Unavailable if it cannot be started.
    explicit Child(Start start);
    ~Child();
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    /// Becomes readable when there is more to take(): for poll.
    int reader() const { return reader_; }

    /// Keep what has come of the captured streams for wait(). False once nothing will come any more.
    bool take();

    void send(int signal) const;

    /// Waits until it is over.
    ProcessEnd wait();

private:
    pid_t process_ = 0;
    int reader_ = -1;
    std::string text_;
};

/// Runs `command`, whose first word is a path, with standard error thrown away, and kills it after `time_limit_s` or when this
/// process ends. `extra_environment` is "NAME=value". Throws Unavailable if it cannot be started.
ProcessEnd run_process(const std::vector<std::string>& command, double time_limit_s,
                       const std::string& extra_environment);

/// At the beginning of main: from here on end with the process that started this one, if that wants it so.
void end_with_parent();

/// What a worker begins with: it ends with its parent, leaves no core file, and takes no more than so much memory, nor than
/// its parent may. Throws Unavailable if it has more already.
void limit_worker(std::size_t memory_bytes);

/// Keeps standard output for the worker's answer alone: whatever is written there, or to standard error, is thrown away from
/// now on. Returns the file for the answer.
int take_standard_output();

/// All of it, whether signals come or not. False if it could not be written.
bool write_all(int file, std::string_view bytes);

}  // namespace bvhbench
