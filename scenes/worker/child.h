// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <string>
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
    Child(Child&& other) noexcept;
    Child& operator=(Child&&) = delete;

    /// Becomes readable when there is more to take(): for poll.
    int reader() const { return reader_; }

    /// Add what has come to text(). False once nothing will come any more.
    bool take();

    /// What was captured, its last part if that was very much and not all is kept.
    const std::string& text() const { return text_; }
    void keep_the_last(std::size_t bytes) { most_bytes_ = bytes; }

    void send(int signal) const;

    /// Waits until it is over. text() goes along.
    ProcessEnd wait();

private:
    pid_t process_ = 0;
    int reader_ = -1;
    std::string text_;
    std::size_t most_bytes_ = 0;  ///< 0: all
};

}  // namespace bvhbench
