// SPDX-License-Identifier: MIT
//
// A kernel that never ends cannot be stopped, by no call of OpenCL 1.2. So whatever measures runs in a child process. Its parent
// waits, ends it when a build or query takes too long, and starts another one after that or after a crash, which gives up
// the cell that was lost and measures the rest (docs/decisions/0012).
#pragma once

#include <functional>
#include <string>

namespace bvhbench {

/// Runs `work` in a child process and returns its exit code. To be called before the process has a second thread. A signal that
/// ends this process is passed on to the child.
///
/// When a build or query is not over in `limit_s`, or anything crashes: if it was for a cell of a run that go_on_with() named,
/// another child goes on with the run. Else throws Unavailable, as where there is no room for a process. With a limit of 0
/// `work` runs in this process, nothing is watched, and a crash is a crash.
int supervised(double limit_s, const std::function<int()>& work);

/// What a child tells its parent, and what the parent tells the next child. Without a parent nobody is told anything.
namespace watchdog {

/// The run that this process goes on with; empty if it begins one.
const std::string& run_id();

/// Why `cell` was given up by a process before this one; empty if it was not.
std::string given_up(const std::string& cell);

/// The run that a process after this one goes on with, by the file that has its finished cells.
void go_on_with(const std::string& run_id);

/// Where the driver keeps compiled kernels, which after a crash may be why.
void kernels_are_in(const std::string& folder);

/// As long as this is there, what is done is done for `cell`.
class Hand {
public:
    explicit Hand(const std::string& cell);
    ~Hand();
    Hand(const Hand&) = delete;
    Hand& operator=(const Hand&) = delete;
};

/// As long as this is there, the time of a build or query runs. Within another one it does nothing.
class Watch {
public:
    Watch();
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

private:
    long until_ = 0;  ///< 0: this one does nothing
};

}  // namespace watchdog
}  // namespace bvhbench
