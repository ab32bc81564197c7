// SPDX-License-Identifier: MIT
#include <algorithm>
#include <iostream>

#include "geometry/error.h"
#include "harness/accuracy/axis.h"
#include "harness/commands.h"
#include "harness/report.h"
#include "harness/report_frames.h"
#include "harness/report_quality.h"
#include "harness/report_refit.h"
#include "harness/report_roofline.h"
#include "harness/report_swept.h"
#include "harness/report_yardstick.h"
#include "harness/run.h"
#include "harness/stress/report.h"

namespace bvhbench {
namespace {

/// With more cells than this, only those that need a look are printed; the file has them all.
constexpr std::size_t most_lines = 100;

/// Frames have a table of their own.
Lines lines_of(const Document& document)
{
    const auto frames =
        std::count_if(document.cells.begin(), document.cells.end(),
                      [](const Cell& cell) { return cell.operation == Operation::collide; });
    const std::size_t others = document.cells.size() - static_cast<std::size_t>(frames);
    return others > most_lines ? Lines::notable : frames > 0 ? Lines::of_builds : Lines::all;
}

/// What the scenes of an experiment may be read from.
std::vector<std::string> files_of(const Experiment& experiment, const SceneLibrary& library)
{
    std::vector<std::string> files;
    const auto add = [&](const std::string& scene) {
        for (std::string& file : scene_files(scene, library))
            files.push_back(std::move(file));
    };
    for (const std::string& scene : experiment.scenes)
        add(scene);
    for (const CollideTask& task : experiment.collisions)
        add(task.scene);
    return files;
}

}  // namespace

int run(const RunCommand& command, const Options& options)
{
    Experiment experiment = find_experiment(command.experiment, command.quick);
    if (command.samples > 0) {
        experiment.samples = command.samples;
        experiment.sampling.until = 0;
        for (CollideTask& task : experiment.collisions)
            task.samples = command.samples;
    }
    command.sampling.apply(experiment.sampling);
    for (CollideTask& task : experiment.collisions)
        task.sampling = experiment.sampling;
    experiment.quality = experiment.quality || command.quality;
    const CellFilter filter = cell_filter(command.filter);
    if (!has_cells(experiment, filter))
        throw BadUsage("--filter: no cell of " + experiment.name + " matches '" + command.filter +
                       "'");
    const bool is_file = command.experiment.ends_with(".json");
    const std::string out = !command.out.empty() ? command.out
                            : is_file            ? experiment.name + "-results.json"
                                                 : experiment.name + ".json";

    Session session(options.common);
    std::vector<std::string> inputs = files_of(experiment, session.scenes());
    if (is_file)
        inputs.push_back(command.experiment);
    Run run(
        session,
        Output(out, "--out",
               result_rules(options.common.force, std::move(inputs), session.watchdog().run_id())),
        options.words, command.costs);
    session.take_turns(command.turns, run.document().run.id);
    run.experiment(experiment, filter);
    run.finish();
    std::cout << run_report(run.document().run)
              << cells_report(run.document(), lines_of(run.document()))
              << frames_table(run.document()) << swept_report(run.document())
              << refit_report(run.document()) << quality_report(run.document())
              << roofline_report(run.document()) << yardstick_report(run.document())
              << run.written();
    return exit_code_of(run.document());
}

int show(const ShowCommand& command, const Options&)
{
    const Document document = read_result_file(command.file);
    std::cout << run_report(document.run) << merged_report(document);
    if (const std::string axes = accuracy_report(document); !axes.empty())
        std::cout << axes;
    else if (!document.stress.empty())
        std::cout << stress_report(document.stress, document.run.libraries);
    else if (document.cells.size() == 1)
        std::cout << cell_report(document.cells.front(), document.run);
    else
        std::cout << cells_report(document, lines_of(document)) << frames_table(document)
                  << swept_report(document) << refit_report(document) << quality_report(document)
                  << roofline_report(document) << yardstick_report(document);
    return 0;
}

}  // namespace bvhbench
