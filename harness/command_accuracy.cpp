// SPDX-License-Identifier: MIT
#include <filesystem>
#include <iostream>

#include "geometry/error.h"
#include "harness/accuracy/axis.h"
#include "harness/commands.h"
#include "harness/plot.h"
#include "harness/report.h"
#include "harness/result_file.h"

namespace bvhbench {

int accuracy(const AccuracyCommand& command, const Options& options)
{
    std::vector<const Axis*> axes;
    if (command.axis.empty())
        for (const Axis& axis : accuracy_axes())
            axes.push_back(&axis);
    else
        axes = {&find_axis(command.axis)};
    AxisTask task{.scenes = command.scenes,
                  .pairs = command.pairs,
                  .seed = command.seed,
                  .samples = command.samples,
                  .filter = cell_filter(command.filter)};
    const std::filesystem::path folder = command.out;
    const std::filesystem::path file =
        folder / (command.axis.empty() ? "accuracy.json" : "accuracy-" + command.axis + ".json");

    Session session(options.common);
    std::vector<std::string> inputs;
    for (const std::string& scene : command.scenes)
        for (std::string& read : scene_files(scene, session.scenes()))
            inputs.push_back(std::move(read));
    make_folder(folder);
    Output output(file, "--out", result_rules(options.common.force, std::move(inputs)));
    ResultFile results(std::move(output), measured_facts(session, options.words));
    Progress progress(axes.size());
    int order = 0;
    for (const Axis* axis : axes) {
        progress.step("accuracy, " + std::string(axis->name));
        axis->measure(
            {session, task, order, progress, [&](Cell&& cell) { results.add(std::move(cell)); }});
    }
    const Document& document = results.document();
    if (document.cells.empty())
        throw BadUsage("--filter: no cell matches '" + command.filter + "'");
    results.finish(session.programs().compile_ns());
    std::cout << run_report(document.run) << accuracy_report(document)
              << "written: " << file.string() << '\n'
              << draw("accuracy.py", file, folder, options.common.force) << '\n';
    for (const Cell& cell : document.cells)
        if (cell.status == Cell::Status::failed)
            throw Unavailable(cell.scene.name + ", " + cell.accuracy.method + ": " + cell.reason);
    return has_differing_cell(document) ? 1 : 0;
}

}  // namespace bvhbench
