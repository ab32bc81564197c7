// SPDX-License-Identifier: MIT
//
// What `bvhbench cluster --simulate` counted, as text and as a file.
#pragma once

#include <string>
#include <vector>

#include "cluster/simulate.h"
#include "harness/base/json_keys.h"
#include "harness/choice/choices.h"
#include "harness/record/record.h"

namespace bvhbench {

struct Simulation {
    SceneFacts scene;
    PartitionBy partition = PartitionBy::rcb;
    BuilderChoice builder;
    unsigned boxes = 0;        ///< that each rank tells all others
    std::int64_t part_ns = 0;  ///< host clock: a frame of the largest part alone, on this device
    std::vector<SimulatedRank> ranks;
};

/// Returns the document, with `run`, the facts of the run.
Json simulation_json(const Simulation& simulation, Json run);

/// Returns a few lines that sum up.
std::string simulation_text(const Simulation& simulation);

}  // namespace bvhbench
