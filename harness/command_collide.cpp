// SPDX-License-Identifier: MIT
#include <iostream>
#include <optional>

#include "builders/orders.h"
#include "collide/narrow_methods.h"
#include "geometry/error.h"
#include "harness/collide.h"
#include "harness/commands.h"
#include "harness/pairs_file.h"
#include "harness/progress.h"
#include "harness/report.h"
#include "harness/report_skips.h"
#include "harness/report_swept.h"
#include "harness/result_file.h"
#include "harness/run.h"
#include "harness/swept.h"

namespace bvhbench {
namespace {

/// Whether --pairs and --contacts have something to write.
void check_lists(const CollideCommand& command, const FrameRange& frames)
{
    for (const std::string& path : {command.pairs, command.contacts})
        if (!path.empty()) {
            check_pairs_path(path, frames);
            if (command.scenes.size() > 1)
                throw BadUsage("--pairs and --contacts write those of one scene, and there are " +
                               std::to_string(command.scenes.size()));
        }
    const bool finds_contacts = find_collider(command.collider.name).finds_contacts;
    if (!command.pairs.empty() && finds_contacts)
        throw BadUsage("collider " + command.collider.name +
                       " finds contacts and no pairs of boxes: --contacts, not --pairs");
    if (!command.contacts.empty() && !finds_contacts && command.collider.narrow == "none")
        throw BadUsage("--contacts needs a narrow phase: --narrow exact");
}

/// Wrong words are found before anything is opened.
CollideTask task_of(const CollideCommand& command)
{
    find_builder(command.builder.name);
    find_order(command.builder.order);
    check_boxes(command.builder);
    find_collider(command.collider.name);
    check_narrow(command.collider.narrow, command.collider.keep_adjacent);
    CollideTask task;
    task.objects = objects_by_called(command.objects);
    task.frames = frame_range(command.frames);
    check_lists(command, task.frames);
    task.between = command.between;
    task.swept = command.swept;
    task.pipelines = {{command.builder, command.collider}};
    for (const SkipRuleEntry& entry : skip_rules())
        if (command.skips && (command.collider.rules_off & entry.rule) == 0) {
            task.pipelines.push_back(task.pipelines.front());
            task.pipelines.back().collider.rules_off |= entry.rule;
        }
    task.needs_scene = command.scenes.size() == 1;
    task.samples = command.samples;
    command.sampling.apply(task.sampling);
    if (task.swept)
        check_swept(task);
    if (task.swept && !command.pairs.empty() && command.collider.among == Among::all)
        throw BadUsage(
            "--pairs writes one list, and --swept finds two: choose by --pairs-of between, "
            "of vertices and faces, or within, of edges");
    return task;
}

}  // namespace

int collide(const CollideCommand& command, const Options& options)
{
    CollideTask task = task_of(command);
    Session session(options.common);
    std::vector<std::string> inputs;
    for (const std::string& scene : command.scenes)
        for (std::string& file : scene_files(scene, session.scenes()))
            inputs.push_back(std::move(file));
    const OutputRules rules =
        result_rules(options.common.force, std::move(inputs), session.watchdog().run_id());
    const Output pairs(command.pairs, "--pairs", rules);
    const Output contacts(command.contacts, "--contacts", rules);
    Output json(command.json, "--json", rules);
    ResultFile results(std::move(json), measured_facts(session, options.words),
                       session.watchdog().run_id());
    PairsFile pairs_file(pairs, task.swept), contacts_file(contacts, task.swept);
    session.watchdog().keep_by(results.document().run.id, [&] {
        results.keep();
        pairs_file.discard();  // the program begins anew
        contacts_file.discard();
    });
    int order = results.next_order();
    std::optional<Progress> progress(command.scenes.size());
    task.note = [&](const std::string& what) { progress->note(task.scene + ", " + what); };
    for (std::size_t i = 0; i < command.scenes.size(); ++i) {
        task.scene = command.scenes[i];
        task.number = std::to_string(i);
        progress->step(task.scene);
        collide_frames(
            session, task, order,
            [&](std::vector<Cell>&& cells, const Found& found) {
                const auto frame = static_cast<std::size_t>(cells.front().scene.frame);
                for (Cell& cell : cells)
                    results.add(std::move(cell));
                if (found.scene == nullptr)
                    return;
                pairs_file.add(found.pairs, frame, *found.scene);
                contacts_file.add(found.contacts, frame, *found.scene);
            },
            [&](std::size_t cells) { return results.pass(cells); });
    }
    progress.reset();  // its line goes before the report comes
    results.finish(session.programs().compile_ns());
    const Document& document = results.document();
    std::cout << run_report(document.run);
    if (document.cells.size() == 1)
        std::cout << cell_report(document.cells.front(), document.run);
    else
        std::cout << frames_report(document);
    std::cout << swept_report(document);
    std::cout << skips_report(document);
    const int code = exit_code_of(document);
    pairs_file.finish();
    contacts_file.finish();
    return code;
}

}  // namespace bvhbench
