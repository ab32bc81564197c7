// SPDX-License-Identifier: MIT
#pragma once

#include "harness/base/json_keys.h"
#include "harness/choice/experiment.h"

namespace bvhbench {

/// What `run` measures: an experiment, or several of one name as the parts of a plan (docs/experiments.md).
struct RunPlan {
    std::string name;
    std::vector<Experiment> parts;
    bool has_parts = false;  ///< each part is measured by a process of its own
    /// Cells of the result that cannot be measured, each with its reason.
    std::vector<Json> impossible = {};
};

/// Returns the embedded experiment of that name as a plan, or reads the file if `name_or_path` ends in .json. Throws BadUsage with
/// the known names, or Unavailable if the file cannot be read.
RunPlan find_plan(const std::string& name_or_path, bool quick);

/// Which scenes of a plan are measured, counted through all parts: the i-th, the (i + n)-th and so on.
struct PlanShare {
    std::size_t i = 1, n = 1;
    bool has(std::size_t scene) const { return scene % n == i - 1; }
};

/// Parses "i/n". Throws BadUsage.
PlanShare share_called(const std::string& text);

}  // namespace bvhbench
