// SPDX-License-Identifier: MIT
#include "harness/measure/collide.h"

#include <algorithm>

#include "geometry/error.h"
#include "harness/base/failure.h"
#include "harness/choice/distance_words.h"
#include "harness/choice/filter_words.h"
#include "harness/measure/frames.h"
#include "scenes/generate/derived.h"

namespace bvhbench {
namespace {

/// Records the options that the scene was chosen with.
void put_choice(const CollideTask& task, SceneFacts& facts)
{
    if (task.objects != ObjectsBy::automatic)
        facts.objects_by = objects_by_name(task.objects);
    facts.between = task.between;
    facts.exclude = task.exclude;
}

/// Returns the task's pipelines with trees and filters as they are over the scene, and says where one tree was chosen. If later frames have other
/// triangles, each object has its own: the first frame says nothing about their objects.
std::vector<PipelineState> pipelines_over(const CollideTask& task, const Scene& scene,
                                          const Input& input, const Session& session)
{
    const ObjectFilter filter = filter_of(task.exclude, scene);
    if (!filter.is_empty() && !scene.later.empty())
        throw BadUsage("'exclude' is about objects of all frames, and frames of scene '" +
                       task.scene + "' have other triangles than the first");
    std::vector<PipelineState> all;
    bool has_chosen = false;
    for (const PipelineChoice& pipeline : task.pipelines) {
        all.push_back({pipeline});
        ColliderChoice& collider = all.back().choice.collider;
        collider.filter = filter;
        collider.distance =
            distance_of(collider.within, box_around(scene.frames.front(), scene.faces));
        if (collider.trees != TreeOver::automatic)
            continue;
        collider.trees = scene.later.empty()
                             ? trees_over(collider, input, session.device().is_cpu())
                             : TreeOver::object;
        has_chosen |= collider.trees == TreeOver::scene;
    }
    if (const auto& tell = session.scenes().tell; has_chosen && tell)
        tell("scene '" + task.scene + "': its " + std::to_string(input.objects.size()) +
             " objects are small and share one tree; --trees object gives each its own");
    return all;
}

/// Throws what loading the scene throws, and BadUsage for frames that it does not have.
void collide_scene(Session& session, const CollideTask& task, int& order, const AddFrame& add,
                   const PassCells& passes)
{
    const Scene scene = scene_of(task, session.scenes());
    const FrameRange frames = frames_of(task, scene.frame_count(), "frames");
    const auto is_between = [](const PipelineChoice& pipeline) {
        return pipeline.collider.among == Among::between_objects;
    };
    if (scene.objects.size() == 1 && std::ranges::all_of(task.pipelines, is_between))
        throw BadUsage("scene '" + task.scene +
                       "' is one object, and there are no pairs between objects");
    if (passes &&
        passes((frames.end - frames.first) * task.pipelines.size() * task.sampling.caches.size()))
        return;
    Input input = upload_frame(session, scene.with_frame(frames.first),
                               scene.later.empty() ? frames.first : 0);
    Contest contest(task.sampling.race, frames.end - frames.first > 1 && scene.later.empty());
    std::vector<PipelineState> all = pipelines_over(task, scene, input, session);
    for (std::size_t frame = frames.first; frame < frames.end; ++frame) {
        const Scene& shown = scene.with_frame(frame);
        if (scene.later.empty()) {
            input.points = scene.frames[frame];
            input.device_points.upload(session.queue().cl(), input.points);
        } else if (frame > frames.first) {  // other triangles: nothing of the frame before serves
            for (PipelineState& one : all)
                one.pipeline.reset();
            input = upload_frame(session, shown, 0);
        }
        FrameOfPipelines now{.input = input,
                             .contest = contest,
                             .number = task.number + '/' + std::to_string(frame),
                             .scene = facts_of(task, shown, frame)};
        if (frame > frames.first && scene.later.empty())
            now.motions = object_motions(scene, frame - 1, frame);
        now.scene.filter_hash = all.empty() ? 0 : all.front().choice.collider.filter.hash();
        now.file_faces = shown.file_faces;
        now.wants_lists = task.wants_lists;
        now.note = note_of(task, "frame " + std::to_string(frame), frame - frames.first,
                           frames.end - frames.first);
        Found found{.scene = &shown};
        add(run_frame(session, task, all, now, order, found), found);
    }
}

}  // namespace

Scene scene_of(const CollideTask& task, const SceneLibrary& library)
{
    SceneLibrary readers = library;
    readers.any_topology = !task.has_features() && task.between == 0 &&
                           std::ranges::none_of(task.pipelines, [](const PipelineChoice& pipeline) {
                               return pipeline.collider.update == FrameUpdate::refit ||
                                      find_collider(pipeline.collider.name).refits;
                           });
    Scene scene = scene_called(task.scene, task.may_stand_in, readers);
    if (task.objects != ObjectsBy::automatic)
        scene = with_objects(std::move(scene), task.objects);
    return task.between > 0 ? with_frames_between(scene, task.between) : scene;
}

FrameRange frames_of(const CollideTask& task, std::size_t there, const char* what)
{
    const FrameRange range{task.frames.first, task.frames.end == 0 ? there : task.frames.end};
    if (range.first >= range.end || range.end > there)
        throw BadUsage("scene '" + task.scene + "' has " + what + " 0 to " +
                       std::to_string(there - 1) + ", not " + std::to_string(range.first) +
                       " to before " + std::to_string(range.end));
    return range;
}

Note note_of(const CollideTask& task, const std::string& what, std::size_t k, std::size_t count)
{
    if (!task.note)
        return {};
    return [&task, what, k, count](const std::string& how, double share) {
        task.note(what + ", " + how, (static_cast<double>(k) + share) / static_cast<double>(count));
    };
}

Cell planned_cell(const CollideTask& task, const PipelineChoice& pipeline)
{
    Cell cell{.experiment = task.experiment,
              .scene = {.name = task.scene},
              .builder = pipeline.builder,
              .collider = pipeline.collider,
              .operation = Operation::collide};
    put_choice(task, cell.scene);
    return cell;
}

SceneFacts facts_of(const CollideTask& task, const Scene& scene, std::size_t frame)
{
    SceneFacts facts = facts_of(scene, scene.stand_in_for.empty() ? task.scene : scene.name, frame);
    put_choice(task, facts);
    return facts;
}

void collide_frames(Session& session, const CollideTask& task, int& order, const AddFrame& add,
                    const PassCells& passes)
{
    const auto collide = [&] {
        (task.has_features() ? collide_features : collide_scene)(session, task, order, add, passes);
    };
    if (task.needs_scene) {
        collide();
        return;
    }
    const std::string why = reason_of_failure(collide);
    if (why.empty() || (passes && passes(task.pipelines.size())))
        return;
    std::vector<Cell> skipped;
    for (const PipelineChoice& pipeline : task.pipelines) {
        skipped.push_back(planned_cell(task, pipeline));
        skipped.back().status = Cell::Status::skipped;
        skipped.back().reason = why;
    }
    add(std::move(skipped), {});
}

}  // namespace bvhbench
