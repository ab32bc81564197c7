// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "harness/base/terminal.h"
#include "harness/measure/planned_scenes.h"
#include "harness/record/result_file.h"
#include "harness/session/session.h"

namespace bvhbench {

/// Returns run_facts (harness/record/provenance.h) with the device's copy rate and launch cost, which it measures. Throws Unavailable
/// if the clocks disagree (Session::check_clocks).
Json measured_facts(Session& session, std::vector<std::string> command,
                    const NodeCosts& costs = {});

/// Runs plans scene by scene: all builders of a scene are prepared and checked, then sampled interleaved.
///
/// A builder or scene that fails leaves a cell with the reason, and the run continues.
class Run {
public:
    /// `results` takes the cells. `common` is for ranks, which are processes of their own.
    Run(Session& session, ResultFile& results, const NodeCosts& costs,
        const CommonOptions& common = {})
        : session_(session)
        , costs_(costs)
        , common_(common)
        , results_(results)
        , order_(results.next_order())
    {}

    /// Measures all cells of an experiment. A cell that cannot be measured has the reason.
    void experiment(const Experiment& experiment);

    /// Measures those scenes of a plan that `results` does not have, and tells of each if the plan has parts. `begin` is called before
    /// the first. Returns false if another process must go on: each part has its own.
    bool scenes(const RunPlan& plan, std::span<const PlannedScene> scenes, const CellFilter& filter,
                const std::function<void()>& begin);

private:
    void measure(const PlannedScene& planned, const CellFilter& filter, Progress& progress);
    void collisions(const Experiment& experiment, CollideTask task, const CellFilter& filter,
                    Progress& progress);
    void cluster(const ClusterTask& task);
    void scene(const Experiment& experiment, const std::string& name,
               std::span<const BuilderChoice> builders, Progress& progress);

    Session& session_;
    NodeCosts costs_;
    CommonOptions common_;
    ResultFile& results_;
    int order_ = 0;
    std::size_t number_ = 0;  ///< of the scene that is measured
};

/// Prints the device with its limits, then one line for each builder, collider and narrow phase over the scenes of `smoke`, each
/// checked against the oracles once and not timed. Meant for reports about untested devices. Returns the exit code. Throws
/// NothingMeasured.
int check_portable(Session& session, std::vector<std::string> command);

}  // namespace bvhbench
