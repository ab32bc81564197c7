// SPDX-License-Identifier: MIT
#pragma once

#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// What a launch takes that has next to nothing to do, measured: the other yardstick of stage times, beside the copy
/// rate.
struct LaunchCost {
    double ns =
        0;  ///< device clock: the span of many launches in a row over their number; the median of `samples`
    int launches = 0;  ///< in a row
    int samples = 0;
};

/// Launch a kernel that reads one word, a group a compute unit, many times in a row, several times.
LaunchCost measure_launch_cost(Programs& programs, Queue& queue);

}  // namespace bvhbench
