// SPDX-License-Identifier: MIT
//
// The axes of steps between two frames. swept: pairs of swept boxes, by several pipelines, against the sweep, pairs known to
// collide during the step, and counts published with the data. impacts: what touches, by each narrow phase, against CGAL too.
#include "collide/narrow/narrow_methods.h"
#include "harness/accuracy/axis.h"
#include "harness/base/failure.h"
#include "harness/measure/collide.h"
#include "scenes/catalog.h"
#include "scenes/manifest.h"

namespace bvhbench {
namespace {

/// Sequences with a ground truth, and the generated scene used if a sequence is missing.
constexpr std::pair<const char*, const char*> own_scenes[] = {
    {"unc_cloth_ball", "cloth-ball:20000:20"},
    {"ipc_armadillo_rollers", "cloth-funnel:10000:20"},
    {"unc_nbody", "n-body:20000:20"},
    {"unc_cloth_funnel", "cloth-funnel:18000:20"}};

/// A scene's name, and the name of the scene it replaces; empty if none.
using NamedScene = std::pair<std::string, std::string>;

/// Returns the scenes asked for, with a bent second frame if they have one frame, or the axis's own.
std::vector<NamedScene> scenes_of(const AxisRun& run)
{
    std::vector<NamedScene> scenes;
    for (const std::string& scene : run.task.scenes) {
        bool stands = false;  // a missing scene is reported by collide_frames
        reason_of_failure(
            [&] { stands = load_scene(scene, run.session.scenes()).frames.size() < 2; });
        scenes.emplace_back(stands ? "bend:" + scene : scene, "");
    }
    if (!scenes.empty())
        return scenes;
    for (const auto& [name, generated] : own_scenes)
        if (located(*manifest_entry(name), run.session.scenes().data).empty()) {
            run.progress.note("accuracy: " + std::string(name) + " is not there, " + generated +
                              " in its place");
            scenes.emplace_back(generated, name);
        } else {
            scenes.emplace_back(name, "");
        }
    return scenes;
}

std::vector<PipelineChoice> pipelines()
{
    const BuilderChoice oi = {.name = "oibvh-single"};
    const BuilderChoice lined_up = {{.order = "hilbert30", .sorted_leaves = true}, "oibvh-single"};
    std::vector<PipelineChoice> all = {{lined_up, {.name = "group"}},
                                       {lined_up, {.name = "block"}},
                                       {oi, {.name = "bvtt"}},
                                       {{.name = "apetrei-fused"}, {.name = "leaf"}},
                                       {{.name = "none"}, {.name = "grid"}}};
    if (find_collider("embree").make != nullptr)
        all.push_back({{.name = "none"}, {.name = "embree"}});
    return all;
}

/// Returns a name such as "group over oibvh-single, hilbert30, sorted leaves".
std::string method_of(const BuilderChoice& builder, const ColliderChoice& collider)
{
    std::string text = collider.name;
    if (builder.name != "none")
        text += " over " + builder.name;
    if (builder.order != BuilderChoice{}.order)
        text += ", " + builder.order;
    return text + (builder.sorted_leaves ? ", sorted leaves" : "");
}

/// Measures pipelines over the steps of an axis's scenes. `method` returns what the axis calls a pipeline.
void measure_steps(
    const AxisRun& run, const std::string& axis, const std::vector<PipelineChoice>& pipelines,
    const std::function<std::string(const BuilderChoice&, const ColliderChoice&)>& method)
{
    for (const auto& [scene, missing_scene] : scenes_of(run)) {
        CollideTask task;
        task.experiment = "accuracy";
        task.scene = scene;
        task.may_stand_in = true;
        task.swept = true;
        task.pipelines = pipelines;
        task.samples = run.task.samples;
        task.warm_up = 1;
        std::erase_if(task.pipelines, [&](const PipelineChoice& one) {
            return !run.task.wants(task.scene, method(one.builder, one.collider));
        });
        if (task.pipelines.empty())
            continue;
        run.progress.note("accuracy, " + axis + ": " + scene);
        const std::string& missing = missing_scene;
        collide_frames(run.session, task, run.order, [&](std::vector<Cell>&& cells, const Found&) {
            for (Cell& cell : cells) {
                cell.operation = Operation::accuracy;
                if (!missing.empty())
                    cell.scene.stand_in_for = missing;
                cell.accuracy = {.axis = axis, .method = method(cell.builder, cell.collider)};
                run.add(std::move(cell));
            }
        });
    }
}

}  // namespace

void measure_swept(const AxisRun& run) { measure_steps(run, "swept", pipelines(), method_of); }

void measure_impacts(const AxisRun& run)
{
    std::vector<PipelineChoice> all;
    for (const NarrowMethod& method : swept_narrow_methods())
        all.push_back({{{.order = "hilbert30", .sorted_leaves = true}, "oibvh-single"},
                       {.name = run.session.device().is_cpu() ? "group" : "block",
                        .narrow = std::string(method.name)}});
    measure_steps(run, "impacts", all, [](const BuilderChoice&, const ColliderChoice& collider) {
        return collider.narrow;
    });
}

}  // namespace bvhbench
