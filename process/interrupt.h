// SPDX-License-Identifier: MIT
//
// Ends the program on SIGINT, SIGTERM and SIGHUP. The program may be reading a pipe, compiling or computing all pairs, and none
// of these can be interrupted. Therefore a separate thread ends the process.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace bvhbench {

/// Returns the signals that end the program: SIGINT, SIGTERM, and SIGHUP unless it is ignored, as under nohup.
std::vector<int> ending_signals();

/// Installs handlers for ending_signals(). On the first signal a sleeping thread wakes, runs the work of all AtSignals,
/// prints one sentence and exits with code 128 + signal. A second signal ends the process at once. Further
/// calls of this function do nothing.
void end_on_signals();

/// Ignores ending_signals() from now on. Does not return if one was received before: the process then ends as end_on_signals() says.
void ignore_signals();

/// Registers work to run when a signal ends the process, for the lifetime of this object.
class AtSignal {
public:
    /// `work` runs on the signal thread, concurrently with the thread that made this object. `kept` is appended to the printed
    /// sentence, as in "finished cells are kept". If `work` throws, its error is printed in place of `kept`.
    explicit AtSignal(std::function<void()> work, std::string kept = {});

    /// Calls `begin` before it registers the work, and no signal ends the process in between.
    AtSignal(const std::function<void()>& begin, std::function<void()> work);
    ~AtSignal();
    AtSignal(const AtSignal&) = delete;
    AtSignal& operator=(const AtSignal&) = delete;

    const std::function<void()> work;
    const std::string kept;
};

}  // namespace bvhbench
