// SPDX-License-Identifier: MIT
//
// What `bvhbench cluster --simulate` counted, as text and as a cell.
#pragma once

#include <string>
#include <vector>

#include "cluster/simulate.h"
#include "harness/choice/cluster_task.h"
#include "harness/record/record.h"

namespace bvhbench {

struct Simulation {
    ClusterTask task;
    SceneFacts scene;
    std::int64_t part_ns = 0;  ///< host clock: a frame of the largest part alone, on this device
    std::vector<SimulatedRank> ranks;
};

/// Returns the cell of a result file.
Cell cell_of(const Simulation& simulation);

/// Returns a few lines that sum up.
std::string simulation_text(const Simulation& simulation);

}  // namespace bvhbench
