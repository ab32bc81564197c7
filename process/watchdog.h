// SPDX-License-Identifier: MIT
//
// OpenCL 1.2 has no call that stops a kernel that never ends. Therefore measuring runs in a child process. The parent waits and
// kills the child when a build, query or oracle takes too long. After that or a crash, it starts another child, which records the lost
// cell, or scene, as failed and measures the rest (docs/decisions/0012).
#pragma once

#include <functional>
#include <string>

namespace bvhbench {

/// Runs `work` in a child process and returns its exit code. Must be called while the process has a single thread. Passes
/// ending_signals() (process/interrupt.h) on to the child. If another signal than those of a crash ends the child, it ends
/// this process too.
///
/// If what a watchdog::Watch limits exceeds `limit_s` or the child crashes during a cell of a run named by resume_after_crash(), another
/// child continues the run; outside of such a cell, Unavailable is thrown, as it is if no process can be made. With a limit of 0,
/// `work` runs in this process without a watchdog.
int supervised(double limit_s, const std::function<int()>& work);

/// Messages from a child to its parent, and from the parent to the next child. Without a parent they have no effect.
namespace watchdog {

/// Returns the id of the run that this process continues; empty if it begins a run.
const std::string& run_id();

/// Returns why an earlier process gave up `cell`; empty if none did.
std::string given_up(const std::string& cell);

/// Names the run that the next child continues, from the journal with its finished cells. Calls let_signals_through().
void resume_after_crash(const std::string& run_id);

/// Lets signals end this process. If it continues a run they are held back before, so that the cells of earlier processes are taken
/// over and kept first.
void let_signals_through();

/// True if a process waits that can start another one.
bool can_begin_another();

/// Asks for another child once this one has ended with code 0. It continues the run that resume_after_crash() names. Signals that the
/// parent receives from now on are passed on to that child.
void begin_another();

/// Names the folder of the driver's compiled kernels. After a crash, the message suggests removing it, unless the program's own
/// code called abort, as a failed assertion does, or the address space is limited, which is then named instead.
void kernels_are_in(const std::string& folder);

/// Marks the work during its lifetime as done for `cell`, and what follows as done for the cell of the CellScope around it, if any.
class CellScope {
public:
    explicit CellScope(const std::string& cell);
    ~CellScope();
    CellScope(const CellScope&) = delete;
    CellScope& operator=(const CellScope&) = delete;

private:
    std::string around_;
};

/// Limits the time of a build, query or oracle, from its construction to its destruction. A nested Watch has no effect.
class Watch {
public:
    Watch();
    ~Watch();
    Watch(const Watch&) = delete;
    Watch& operator=(const Watch&) = delete;

private:
    long until_ = 0;  ///< deadline; 0: this object has no effect
};

}  // namespace watchdog
}  // namespace bvhbench
