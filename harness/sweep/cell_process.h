// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>

#include "harness/options.h"
#include "harness/record.h"
#include "harness/sweep/folder.h"
#include "harness/sweep/units.h"
#include "scenes/worker/child.h"

namespace bvhbench {

/// One unit of a sweep at work: this program's command `run` in a process of its own.
class CellProcess {
public:
    /// Throws Unavailable if it cannot be started, or its experiment not written.
    CellProcess(const SweepUnit& unit, const SweepFolder& folder, const Options& options,
                const NodeCosts& costs, const std::string& device);

    const SweepUnit& unit() const { return unit_; }
    Child& child() { return child_; }
    double seconds() const;

    /// Waits for its end. Empty if the unit is done; else why it is not, and whether there is no such cell rather than one
    /// that failed.
    struct Loss {
        std::string why;
        bool is_skipped = false;
        bool may_be_the_device = false;  ///< whether that may be gone
        bool was_stopped = false;        ///< by a signal that asks a program to end
    };
    Loss end();

    /// It has taken this long, and is ended.
    void give_up(double limit_s);

private:
    const SweepUnit& unit_;
    std::filesystem::path cell_file_;
    std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
    Child child_;
    std::string given_up_;
};

}  // namespace bvhbench
