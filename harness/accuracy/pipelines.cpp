// SPDX-License-Identifier: MIT
//
// The axes about whole pipelines. swept: pairs of boxes swept between two frames, by several pipelines, against the sweep, pairs known to
// collide during the step, and counts published with the data. impacts: what touches on the way, by each narrow phase, against CGAL too.
// distance: triangles within a distance, by each narrow phase, against CGAL.
#include "collide/narrow/narrow_methods.h"
#include "harness/accuracy/axis.h"
#include "harness/base/failure.h"
#include "harness/measure/collide.h"
#include "scenes/catalog.h"
#include "scenes/manifest.h"

namespace bvhbench {
namespace {

/// A scene, and the generated one that is used if it is missing.
using StandIn = std::pair<const char*, const char*>;

constexpr StandIn own_scenes[] = {
    {"unc_cloth_ball", "cloth-ball:20000:20"}, {"ipc_armadillo_rollers", "cloth-funnel:10000:20"},
    {"unc_nbody", "n-body:20000:20"},          {"unc_cloth_funnel", "cloth-funnel:18000:20"},
    {"ipc_rod_twist", "bend:torus:20000"},     {"ipc_thick_cloth", "cloth-layers:400:20"}};

constexpr StandIn distance_scenes[] = {{"unc_cloth_ball", "cloth-ball:20000:20"},
                                       {"unc_nbody", "n-body:20000:20"},
                                       {"armadillo_86482", "torus:20000"},
                                       {"bunny", "sphere:20000"},
                                       {"ipc_armadillo_rollers", "cloth-funnel:10000:20"}};

/// A scene's name, and the name of the scene it replaces; empty if none.
using NamedScene = std::pair<std::string, std::string>;

/// Returns the scenes asked for, `swept` with a bent second frame if they have one frame, or the axis's own.
std::vector<NamedScene> scenes_of(const AxisRun& run, bool swept)
{
    std::vector<NamedScene> scenes;
    for (const std::string& scene : run.task.scenes) {
        bool stands = false;  // a missing scene is reported by collide_frames
        reason_of_failure(
            [&] { stands = swept && load_scene(scene, run.session.scenes()).frames.size() < 2; });
        scenes.emplace_back(stands ? "bend:" + scene : scene, "");
    }
    if (!scenes.empty())
        return scenes;
    for (const auto& [name, generated] :
         swept ? std::span<const StandIn>(own_scenes) : distance_scenes)
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
    for (const ColliderEntry& entry : collider_catalog())
        if (entry.outside != nullptr && entry.outside->method.steps)
            all.push_back({{.name = "none"}, {.name = std::string(entry.name)}});
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

/// Returns what an axis calls a pipeline.
using MethodName = std::function<std::string(const BuilderChoice&, const ColliderChoice&)>;

/// Measures pipelines over an axis's scenes: over the steps between frames if `swept`, else in the first frame.
void measure_pipelines(const AxisRun& run, const std::string& axis, bool swept,
                       const std::vector<PipelineChoice>& pipelines, const MethodName& method)
{
    for (const auto& [scene, missing_scene] : scenes_of(run, swept)) {
        CollideTask task;
        task.experiment = "accuracy";
        task.scene = scene;
        task.may_stand_in = true;
        task.swept = swept;
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

/// Measures each narrow phase that decides `question`, and the exact one, behind the fastest pipeline. Distances are shares of the
/// diagonal: what contacts of cloth are kept apart by, and what a planner of paths asks for.
void measure_narrow_phases(const AxisRun& run, const std::string& axis, NarrowOf question)
{
    const bool is_step = question == NarrowOf::step;
    std::vector<std::string> names;
    if (!is_step)
        names.emplace_back("exact");
    for (const NarrowMethod& method : narrow_methods(question))
        names.emplace_back(method.name);
    std::vector<PipelineChoice> all;
    for (const std::string& distance :
         is_step ? std::vector{run.task.separation} : std::vector<std::string>{"0.1%", "1%"})
        for (const std::string& narrow : names) {
            const AxisMethod fastest = fastest_method(run.session, "", "f32", narrow);
            PipelineChoice& one =
                all.emplace_back(PipelineChoice{fastest.builder, fastest.collider});
            (is_step ? one.collider.separation : one.collider.within) = distance;
            one.collider.trees = TreeOver::automatic;
        }
    measure_pipelines(
        run, axis, is_step, all,
        [](const BuilderChoice&, const ColliderChoice& collider) { return collider.narrow; });
}

}  // namespace

void measure_swept(const AxisRun& run)
{
    measure_pipelines(run, "swept", true, pipelines(), method_of);
}

void measure_impacts(const AxisRun& run) { measure_narrow_phases(run, "impacts", NarrowOf::step); }

void measure_distance(const AxisRun& run)
{
    measure_narrow_phases(run, "distance", NarrowOf::distance);
}

}  // namespace bvhbench
