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
    const OutputRules rules = result_rules(options.common.force, std::move(inputs));
    check_pictures(folder, "--out", rules);
    Output output(file, "--out", rules);
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
    std::cout << run_report(document.run) << accuracy_report(document) << results.written();
    const int code = exit_code_of(document);
    std::cout << draw("accuracy.py", file, folder, options.common.force) << '\n';
    return code;
}

}  // namespace bvhbench
