// SPDX-License-Identifier: MIT
//
// What becomes of the program when SIGINT, SIGTERM or SIGHUP asks it to end. It may be reading a pipe, compiling or looking
// for all pairs at that time, none of which can be asked to stop. So a thread ends the process.
#pragma once

#include <functional>
#include <string>

namespace bvhbench {

/// From here on SIGINT, SIGTERM and SIGHUP end the process, with exit code 128 + signal and one sentence: a thread, which
/// sleeps until then, does what each AtSignal says and exits. A second signal ends the process without that. A SIGHUP
/// that was ignored before, as under nohup, still is. A second call does nothing.
void end_on_signals();

/// What a signal does before it ends the process, as long as this object is there.
class AtSignal {
public:
    /// `work` is done by another thread, while the one that made this goes on. `kept` ends the sentence: "finished cells
    /// are kept". What `work` throws is said in its place.
    explicit AtSignal(std::function<void()> work, std::string kept = {});
    ~AtSignal();
    AtSignal(const AtSignal&) = delete;
    AtSignal& operator=(const AtSignal&) = delete;

    const std::function<void()> work;
    const std::string kept;
};

}  // namespace bvhbench
