// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>

#include "benchmarks/held_scene.h"
#include "benchmarks/iterations.h"
#include "benchmarks/plan.h"
#include "harness/measure/run.h"

namespace bvhbench {

/// The cells of a plan on one device. A scene is loaded, and those of its cells that are wanted are settled and judged, when the
/// first of them runs. The scene is released when a cell of another scene runs.
class Cells {
public:
    /// `wanted` are the names of cells that will run. `plan` must outlive this object.
    Cells(Session& session, const Plan& plan, std::set<std::string> wanted);

    /// Runs the iterations of `state` by take_iterations, and judges the cell again. Then `state` has the cell's counters and
    /// verdict, or an error if its result is wrong or it cannot be measured.
    void run(benchmark::State& state, const PlannedCell& planned, const std::string& stage,
             Outcome& outcome);

private:
    void load(const PlannedCell& planned);
    Subject* find(const PlannedCell& planned);
    std::string reason_without(const PlannedCell& planned) const;
    std::string sampled(benchmark::State& state, Subject& subject, const std::string& stage);

    Session& session_;
    const Plan& plan_;
    std::set<std::string> wanted_;
    Run run_;
    int order_ = 0;
    std::map<std::string, std::string> failed_;  ///< why cells cannot be measured
    std::vector<Cell> ended_;     ///< cells that the scene's measurement has ended with
    std::set<std::string> warm_;  ///< cells of the scene whose warm-up was run
    std::size_t scene_ = 0;       ///< number of the scene held
    std::unique_ptr<HeldScene> held_;
};

}  // namespace bvhbench
