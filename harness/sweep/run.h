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

/// Measures what is not done yet of `units`, a process each, as many at once as there are devices. One that crashes costs
/// its own cells. Ends early, with all processes ended, when a signal was deferred. Throws Unavailable if the device is gone
/// or results cannot be written. What is done stays.
void run_units(const Sweep& sweep, const std::vector<SweepUnit>& units, const SweepFolder& folder,
               const SweepTask& task, const Options& options, const RunFacts& facts);

}  // namespace bvhbench
