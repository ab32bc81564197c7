// SPDX-License-Identifier: MIT
#include "benchmarks/plan.h"

#include <algorithm>

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

/// Returns the pipelines as their cells have them: without a builder that is not used, and for swept boxes one for each kind of
/// pairs.
std::vector<PipelineChoice> pipelines_of(const CollideTask& task)
{
    std::vector<PipelineChoice> all;
    for (PipelineChoice pipeline : task.pipelines) {
        if (!find_collider(pipeline.collider.name).needs_tree)
            pipeline.builder = {.name = "none"};
        const Among asked = pipeline.collider.among;
        pipeline.collider.keep_adjacent &= !task.swept;
        for (const Among among : {Among::all, Among::between_objects, Among::within_objects}) {
            pipeline.collider.among = among;
            if (task.swept ? among != Among::all && (asked == Among::all || asked == among)
                           : asked == among)
                all.push_back(pipeline);
        }
    }
    return all;
}

template <class Item>
void add_once(std::vector<Item>& list, const Item& item)
{
    if (std::find(list.begin(), list.end(), item) == list.end())
        list.push_back(item);
}

}  // namespace

Plan plan_of(const Experiment& experiment, const std::string& stage)
{
    Plan plan;
    std::set<std::string> names;
    const auto add = [&](const std::string& scene, PlannedCell cell) {
        const bool hierarchy = cell.collider.name.empty() && stage.empty() &&
                               experiment.start == Start::from_sorted_leaves;
        cell.name = printable(experiment.name + '/' + scene + name_of(cell) + '/' +
                              (hierarchy       ? "hierarchy"
                               : stage.empty() ? "whole"
                                               : stage));
        cell.scene = plan.scenes.size() - 1;
        if (names.insert(cell.name).second)
            plan.cells.push_back(std::move(cell));
    };
    Experiment one = experiment;
    one.scenes = {};
    for (CollideTask task : experiment.collisions) {
        task.frames.end = task.frames.first + 1;
        one.collisions = {task};
        plan.scenes.push_back(one);
        for (const PipelineChoice& pipeline : pipelines_of(task))
            add(task.scene + options_text({.scene = task}, Choice::Of::scene),
                {{}, 0, Operation::collide, pipeline.builder, pipeline.collider});
    }
    one.collisions = {};
    for (const std::string& scene : experiment.scenes) {
        one.scenes = {scene};
        plan.scenes.push_back(one);
        for (const BuilderChoice& builder : experiment.builders)
            for (const Operation operation : experiment.operations)
                add(scene, {{}, 0, operation, builder});
    }
    return plan;
}

Experiment narrowed(const Plan& plan, std::size_t scene, const std::set<std::string>& names)
{
    Experiment one = plan.scenes[scene];
    one.builders = {};
    one.operations = {};
    for (CollideTask& task : one.collisions)
        task.pipelines = {};
    for (const PlannedCell& cell : plan.cells) {
        if (cell.scene != scene || !names.contains(cell.name))
            continue;
        for (CollideTask& task : one.collisions)
            task.pipelines.push_back({cell.builder, cell.collider});
        add_once(one.builders, cell.builder);
        add_once(one.operations, cell.operation);
    }
    return one;
}

}  // namespace bvhbench
