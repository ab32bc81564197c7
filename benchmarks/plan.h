// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "harness/choice/experiment.h"
#include "harness/record/record.h"

namespace bvhbench {

/// A cell as a benchmark. Its name has the experiment, scene, builder, "refit" if it is one, collider, and the stage that is
/// timed. Options that are not the defaults follow what they belong to: "pairs/bunny/objects:one/karras/leaf/whole".
struct PlannedCell {
    std::string name;
    std::size_t scene = 0;  ///< index in Plan::scenes
    Operation operation = Operation::build;
    BuilderChoice builder;
    ColliderChoice collider = {};  ///< empty name: none
    bool is_wanted = true;         ///< whether it is to run
    std::string failure = {};      ///< why it cannot be measured

    bool is(const Cell& cell) const
    {
        return cell.operation == operation && cell.collider == collider &&
               (builder.name == "none" || cell.builder == builder);
    }
};

/// An experiment, split by scene. Of a scene with several frames the first one is planned: how many there are is known only when
/// it is loaded.
struct Plan {
    std::vector<Experiment> scenes;  ///< each has one task, or one scene with builders
    std::vector<PlannedCell> cells;  ///< their names differ
};

/// Plans all cells; loads nothing. If `stage` is not empty, that stage of each sample is timed.
Plan plan_of(Experiment experiment, const std::string& stage);

}  // namespace bvhbench
