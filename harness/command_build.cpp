// SPDX-License-Identifier: MIT
#include <iostream>

#include "builders/orders.h"
#include "harness/commands.h"
#include "harness/dump.h"
#include "harness/report.h"
#include "harness/run.h"
#include "scenes/face_order.h"

namespace bvhbench {
namespace {

/// Build once more and write the tree: measuring has its own copy of the scene, which is gone by now.
void dump(Session& session, const BuildCommand& command, const Output& output)
{
    const Scene scene = in_file_order(load_scene(command.scene, session.scenes()));
    const Input input =
        upload(session.device(), session.queue(), scene.frames.front(), scene.faces);
    Builder& builder = session.builder(command.builder);
    builder.reserve(input.triangle_count());
    const Tree* tree = nullptr;
    session.build_once(builder, input, Start::from_triangles, &tree);
    output.replace(dump_text(tree->spelled_out()));
}

}  // namespace

int build(const BuildCommand& command, const Options& options)
{
    // Wrong words are found before anything is opened.
    find_builder(command.builder.name);
    find_order(command.builder.order);
    check_boxes(command.builder);

    Experiment experiment;
    experiment.name = "build";
    experiment.scenes = {command.scene};
    experiment.builders = {command.builder};
    experiment.samples = command.samples;
    command.sampling.apply(experiment.sampling);
    experiment.quality = command.quality;
    experiment.may_stand_in = false;  // who names a mesh means that mesh
    experiment.needs_scene = true;

    Session session(options.common);
    const auto rules =
        result_rules(options.common.force, scene_files(command.scene, session.scenes()),
                     session.watchdog().run_id());
    const Output dumped(command.dump, "--dump", rules);
    Run run(session, Output(command.json, "--json", rules), options.words, command.costs);
    run.experiment(experiment);
    run.finish();
    const int code = exit_code_of(run.document());
    std::cout << run_report(run.document().run)
              << cell_report(run.document().cells.front(), run.document().run);
    if (!dumped.is_nowhere())
        dump(session, command, dumped);
    return code;
}

}  // namespace bvhbench
