// SPDX-License-Identifier: MIT
//
// What a sweep's processes are told: cells as experiments write them.
#pragma once

#include <string>
#include <vector>

#include "harness/sweep/plan.h"

namespace bvhbench {

/// The cells of one process, as an experiment that `run` takes: all of one scene, all builds or none.
Json experiment_of(const Sweep& sweep, const std::vector<SweepCell>& cells);

/// What a result file tells of a cell: two of which it is the same are taken for each other.
std::string told(const SweepCell& cell);

}  // namespace bvhbench
