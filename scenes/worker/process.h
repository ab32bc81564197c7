// SPDX-License-Identifier: MIT
//
// Child processes: Python, and this program itself for tasks that may crash or use too much memory.
#pragma once

#include <sys/types.h>

#include <string>
#include <string_view>
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
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    pid_t process() const { return process_; }

    /// Returns a file descriptor for poll that becomes readable when take() can read more.
    int reader() const { return reader_; }

    /// Reads available output of the captured streams and keeps it for wait(). False at the end of the output.
    bool take();

    void send(int signal) const;

    pid_t id() const { return process_; }

    /// Waits until the process has ended.
    ProcessEnd wait();

private:
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

/// A file in memory that child processes can read and write by its path while this object exists.
class MemoryFile {
public:
    /// Throws Unavailable if there is no room for the bytes.
    explicit MemoryFile(std::string_view bytes = {});
    ~MemoryFile();
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    std::string path() const;

    /// Returns the size in bytes, which a child may have changed.
    std::size_t size() const;

    /// Reads `bytes` from the front of the file. False if there are fewer.
    bool read(void* to, std::size_t bytes) const;

private:
    int file_;
};

/// Makes this process end with its parent, if the parent asked for it. Called at the beginning of main.
void end_with_parent();

/// First call of a worker: makes it end with its parent, disables core files, and limits its memory to `memory_bytes`, or to
/// host_memory_left() if that is less. Throws Unavailable if the worker already has more.
void limit_worker(std::size_t memory_bytes);

/// Reserves standard output for the worker's answer: other output to it or to standard error is discarded from now on. Returns
/// the file descriptor for the answer.
int take_standard_output();

/// Writes all bytes, also when signals interrupt it. False if they could not be written.
bool write_all(int file, std::string_view bytes);

}  // namespace bvhbench
