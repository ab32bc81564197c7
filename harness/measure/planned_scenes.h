// SPDX-License-Identifier: MIT
//
// Which scenes of a plan are measured, and which of their cells.
#pragma once

#include <re2/re2.h>

#include <memory>
#include <string>
#include <vector>

#include "harness/choice/run_plan.h"
#include "harness/record/record.h"
#include "scenes/catalog.h"

namespace bvhbench {

/// Selects the cells whose "scene/builder" or "scene/builder/collider" matches; null: all cells. RE2 takes time linear in the
/// length of the texts, for every expression.
using CellFilter = std::shared_ptr<const re2::RE2>;

/// Returns the files and folders that loading these scenes may read.
std::vector<std::string> files_of(const std::vector<std::string>& scenes,
                                  const SceneLibrary& library);

/// Returns the filter for the option --filter or `option`; null if `text` is empty. Throws BadUsage if it is not a regular expression.
CellFilter cell_filter(const std::string& text, const char* option = "--filter");

/// True if any part of `cell` matches the filter, or if that is null.
bool passes(const CellFilter& filter, const std::string& cell);

/// A scene of a plan, with its builders, with its pipelines, or on several ranks.
struct PlannedScene {
    const Experiment* experiment;
    std::size_t number;           ///< among all scenes of the plan
    const CollideTask* collides;  ///< nullptr: a scene of builds, `name`, or of ranks
    const ClusterTask* cluster;   ///< nullptr: not of ranks
    std::string name;
    std::string key;  ///< a hash of all that decides what is measured; empty: it has none
    double weight;    ///< for guesses of its time: cells times triangles, as far as these are known
};

/// Returns the scenes that have a cell that matches. `settings` is what decides beside the plan; empty: there are no keys. They
/// refer to `plan`.
std::vector<PlannedScene> planned_scenes(const RunPlan& plan, const CellFilter& filter,
                                         const PlanShare& share, const std::string& settings);

/// Returns the cells of the scene that match, without measurements, as skipped.
std::vector<Cell> planned_cells(const PlannedScene& planned, const CellFilter& filter);

/// Returns the experiment's builders whose cells over `scene` match; and the task's pipelines that do.
std::vector<BuilderChoice> chosen(const Experiment& experiment, const std::string& scene,
                                  const CellFilter& filter);
std::vector<PipelineChoice> chosen(const CollideTask& task, const CellFilter& filter);

}  // namespace bvhbench
