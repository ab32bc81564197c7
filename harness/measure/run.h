// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "harness/base/pattern.h"
#include "harness/base/terminal.h"
#include "harness/choice/experiment.h"
#include "harness/record/result_file.h"
#include "harness/session/session.h"

namespace bvhbench {

class Frames;
class Oracle;

/// Which cells to run: those whose "scene/builder" it matches; all without one.
using CellFilter = std::optional<Pattern>;

/// Files and folders that loading these scenes may read.
std::vector<std::string> files_of(const std::vector<std::string>& scenes,
                                  const SceneLibrary& library);

/// What --filter says; none if it is empty. Throws BadUsage if it is no regular expression.
CellFilter cell_filter(const std::string& text);

/// Whether the experiment has a cell that matches.
bool has_cells(const Experiment& experiment, const CellFilter& filter);

/// What is known of a run when it starts, with the device's copy rate, the yardstick of the run, measured.
RunFacts measured_facts(Session& session, std::vector<std::string> command,
                        const NodeCosts& costs = {});

/// Runs experiments: scene by scene, all builders of a scene prepared, checked, then sampled interleaved.
///
/// A builder or scene that fails is a cell that says so, and the run goes on.
class Run {
public:
    /// Measures the device's copy rate, the yardstick of the run. To nowhere no file is written.
    Run(Session& session, Output output, std::vector<std::string> command, const NodeCosts& costs);

    /// What cannot be measured is a cell that says so.
    void experiment(const Experiment& experiment, const CellFilter& filter = {});

    /// End the run and write its file.
    void finish();

    const ResultFile& results() const { return results_; }

private:
    struct Built;
    struct Oracles;

    void collisions(CollideTask task, const CellFilter& filter, Progress& progress);
    void scene(const Experiment& experiment, const std::string& name,
               std::span<const BuilderChoice> builders, Progress& progress);
    void settle(const Experiment& experiment, const Frames& frames, Cell& cell, Built& built,
                Oracles& oracles);
    void judge_build(const Experiment& experiment, const Frames& frames, Cell& cell, Built& built,
                     Oracle& oracle);
    void judge_refit(const Experiment& experiment, const Frames& frames, Cell& cell, Built& built,
                     Oracle& oracle);

    Session& session_;
    NodeCosts costs_;
    ResultFile results_;
    int order_ = 0;
    int scenes_ = 0;  ///< begun so far
};

/// Prints the device with its limits, and a line for each builder, collider and narrow phase over the scenes of `smoke`: held to
/// the oracles once and not timed. What a user of a device that nobody has tried runs and sends. Returns the exit code; throws
/// NothingMeasured.
int check_portable(Session& session, std::vector<std::string> command);

}  // namespace bvhbench
