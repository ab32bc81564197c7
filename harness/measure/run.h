// SPDX-License-Identifier: MIT
#pragma once

#include <re2/re2.h>

#include <memory>

#include "harness/base/terminal.h"
#include "harness/choice/experiment.h"
#include "harness/record/result_file.h"
#include "harness/session/session.h"

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

/// Returns the number of scenes of the experiment, of builds and of collisions, that have a cell that matches.
std::size_t parts_of(const Experiment& experiment, const CellFilter& filter);

/// Returns run_facts (harness/record/provenance.h) with the device's copy rate and launch cost, which it measures. Throws Unavailable
/// if the clocks disagree (Session::check_clocks).
Json measured_facts(Session& session, std::vector<std::string> command,
                    const NodeCosts& costs = {});

/// Runs experiments scene by scene: all builders of a scene are prepared and checked, then sampled interleaved.
///
/// A builder or scene that fails leaves a cell with the reason, and the run continues.
class Run {
public:
    /// Measures the device's copy rate and launch cost. Writes no file if `output` is a default Output.
    Run(Session& session, Output output, std::vector<std::string> command, const NodeCosts& costs);

    /// Measures all cells of the experiment that match. A cell that cannot be measured has the reason.
    void experiment(const Experiment& experiment, const CellFilter& filter = {});

    /// Ends the run and writes its file.
    void finish();

    const ResultFile& results() const { return results_; }

private:
    void collisions(CollideTask task, const CellFilter& filter, Progress& progress);
    void scene(const Experiment& experiment, const std::string& name,
               std::span<const BuilderChoice> builders, Progress& progress);

    Session& session_;
    NodeCosts costs_;
    ResultFile results_;
    int order_ = 0;
    int scenes_ = 0;  ///< number of scenes begun so far
};

/// Prints the device with its limits, then one line for each builder, collider and narrow phase over the scenes of `smoke`, each
/// checked against the oracles once and not timed. Meant for reports about untested devices. Returns the exit code. Throws
/// NothingMeasured.
int check_portable(Session& session, std::vector<std::string> command);

}  // namespace bvhbench
