// SPDX-License-Identifier: MIT
#include "benchmarks/plan.h"

#include <set>

#include "harness/base/terminal.h"
#include "harness/choice/choices.h"

namespace bvhbench {
namespace {

/// Returns the options of `of` that are not the defaults: "/order:hilbert30/leaves:sorted".
std::string options_text(const CellChoice& choice, Choice::Of of)
{
    const Json usual = choices_json({}, of), chosen = choices_json(choice, of);
    std::string text;
    for (const auto& [key, value] : chosen.items())
        if (value != usual[key])
            text += '/' + key + ':' + (value.is_string() ? value.get<std::string>() : value.dump());
    return text;
}

std::string name_of(const PlannedCell& cell)
{
    const CellChoice choice{.builder = cell.builder, .collider = cell.collider};
    std::string text;
    if (cell.builder.name != "none")
        text += '/' + cell.builder.name + options_text(choice, Choice::Of::builder);
    if (cell.operation == Operation::refit)
        text += "/refit";
    if (!cell.collider.name.empty())
        text += '/' + cell.collider.name + options_text(choice, Choice::Of::query) +
                options_text(choice, Choice::Of::collider);
    return text;
}

/// Returns the pipelines as their cells have them: without a builder that is not used, and for features one for each kind of
/// pairs.
std::vector<PipelineChoice> pipelines_of(const CollideTask& task)
{
    std::vector<PipelineChoice> all;
    for (PipelineChoice pipeline : task.pipelines) {
        if (!find_collider(pipeline.collider.name).needs_tree)
            pipeline.builder = {.name = "none"};
        if (!task.has_features())
            all.push_back(pipeline);
        const Among asked = pipeline.collider.among;
        pipeline.collider.keep_adjacent &= !task.has_features();
        for (const Among among : {Among::between_objects, Among::within_objects}) {
            pipeline.collider.among = among;
            if (task.has_features() && (asked == Among::all || asked == among))
                all.push_back(pipeline);
        }
    }
    return all;
}

}  // namespace

Plan plan_of(Experiment experiment, const std::string& stage)
{
    Plan plan;
    std::set<std::string> names;
    const auto add = [&](const std::string& scene, PlannedCell cell) {
        std::string timed = stage.empty() ? "whole" : stage;
        if (cell.collider.name.empty() && stage.empty() &&
            experiment.start == Start::from_sorted_leaves)
            timed = "hierarchy";
        cell.name = printable(experiment.name + '/' + scene + name_of(cell) + '/' + timed);
        cell.scene = plan.scenes.size() - 1;
        if (names.insert(cell.name).second)
            plan.cells.push_back(std::move(cell));
    };
    const std::vector<std::string> scenes = std::exchange(experiment.scenes, {});
    for (CollideTask task : std::exchange(experiment.collisions, {})) {
        task.frames.end = task.frames.first + 1;
        task.needs_scene = true;
        plan.scenes.push_back(experiment);
        plan.scenes.back().collisions = {task};
        for (const PipelineChoice& pipeline : pipelines_of(task))
            add(task.scene + options_text({.scene = task}, Choice::Of::scene),
                {{}, 0, Operation::collide, pipeline.builder, pipeline.collider});
    }
    for (const std::string& scene : scenes) {
        plan.scenes.push_back(experiment);
        plan.scenes.back().scenes = {scene};
        for (const BuilderChoice& builder : experiment.builders)
            for (const Operation operation : experiment.operations)
                add(scene, {{}, 0, operation, builder});
    }
    return plan;
}

}  // namespace bvhbench
