// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace bvhbench {

/// How a process ended and what it wrote to standard output.
struct ProcessEnd {
    enum class How { exited, signalled, timed_out };
    How how = How::exited;
    int code = 0;  ///< exit code or signal
    std::string output;
};

/// Spawns `command`, whose first word is a path, with nothing on standard input and standard error
/// thrown away, and waits for it to end; kills it after `time_limit_s`. `extra_environment` is "NAME=value".
/// Throws Unavailable if it cannot be started.
ProcessEnd run_process(const std::vector<std::string>& command, double time_limit_s,
                       const std::string& extra_environment);

/// "crashed (signal 11)", "took longer than 120 s" or "ended with exit code 1".
std::string spelled(const ProcessEnd& end, double time_limit_s);

}  // namespace bvhbench
