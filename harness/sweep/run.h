// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "harness/node_costs.h"
#include "harness/options.h"
#include "harness/sweep/folder.h"
#include "harness/sweep/time_left.h"
#include "harness/sweep/units.h"

namespace bvhbench {

/// How a sweep is gone through.
struct SweepTask {
    std::vector<std::string>
        devices;  ///< one a process: words or indices, "" for the usual one; some may be the same
    NodeCosts costs;
    double cell_limit_s = 0;  ///< of a process; 0: none
    bool retry_failed = false;
    std::function<void(const std::string& line)> tell;
};

/// What became of a sweep's cells.
struct SweepEnd {
    std::size_t units = 0;  ///< that are to be done
    std::size_t done = 0;   ///< of them
    bool differs = false;   ///< whether an answer is wrong
};

/// Measures what is not done yet of `units`, a process each, as many at once as there are devices. One that crashes costs
/// its own cells. Throws Interrupted, with all processes ended, and Unavailable if the device is gone or results cannot be
/// written: what is done stays.
SweepEnd run_units(const Sweep& sweep, const std::vector<SweepUnit>& units,
                   const SweepFolder& folder, const SweepTask& task, const Options& options,
                   const RunFacts& facts);

}  // namespace bvhbench
