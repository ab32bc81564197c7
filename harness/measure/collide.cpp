// SPDX-License-Identifier: MIT
#include "harness/measure/collide.h"

#include <algorithm>

#include "geometry/error.h"
#include "harness/base/failure.h"
#include "harness/measure/frame_cells.h"
#include "harness/measure/swept.h"
#include "scenes/generate/derived.h"

namespace bvhbench {
namespace {

/// What a cell's scene is called, and how it was asked for.
SceneFacts asked_scene(const CollideTask& task)
{
    SceneFacts scene;
    scene.name = task.scene;
    if (task.objects != ObjectsBy::automatic)
        scene.objects_by = objects_by_name(task.objects);
    scene.between = task.between;
    return scene;
}

/// A cell of each pipeline that says why there is none.
std::vector<Cell> skipped_cells(const CollideTask& task, const std::string& why)
{
    std::vector<Cell> cells;
    for (const PipelineChoice& pipeline : task.pipelines) {
        Cell& cell = cells.emplace_back();
        cell.experiment = task.experiment;
        cell.scene = asked_scene(task);
        cell.builder = pipeline.builder;
        cell.collider = pipeline.collider;
        cell.operation = Operation::collide;
        cell.status = Cell::Status::skipped;
        cell.reason = why;
    }
    return cells;
}

}  // namespace

Scene scene_of(const CollideTask& task, const SceneLibrary& library)
{
    Scene scene =
        task.may_stand_in ? load_or_stand_in(task.scene, library) : load_scene(task.scene, library);
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

SceneFacts facts_of(const CollideTask& task, const Scene& scene, std::size_t frame)
{
    SceneFacts facts = asked_scene(task);
    if (!scene.stand_in_for.empty())
        facts.name = scene.name;
    facts.triangles = scene.triangle_count();
    facts.vertices = static_cast<std::int64_t>(scene.frames.front().size());
    facts.objects = static_cast<std::int64_t>(scene.objects.size());
    facts.frame = static_cast<std::int64_t>(frame);
    facts.source = scene.source;
    facts.stand_in_for = scene.stand_in_for;
    facts.outlier = scene.outlier;
    facts.rounding = scene.rounding;
    facts.bend_of = scene.bend_of;
    facts.content_hash = scene.content_hash;
    return facts;
}

namespace {

/// Throws what loading the scene does, and BadUsage for frames that it has not.
void collide_scene(Session& session, const CollideTask& task, int& order,
                   const std::function<void(std::vector<Cell>&&, const Found&)>& add,
                   const std::function<bool(std::size_t cells)>& passes)
{
    const Scene scene = scene_of(task, session.scenes());
    const FrameRange frames = frames_of(task, scene.frames.size(), "frames");
    const bool finds_nothing =
        scene.objects.size() == 1 &&
        std::ranges::all_of(task.pipelines, [](const PipelineChoice& pipeline) {
            return pipeline.collider.among == Among::between_objects;
        });
    if (finds_nothing)
        throw BadUsage("scene '" + task.scene +
                       "' is one object, and there are no pairs between objects");
    if (passes && passes((frames.end - frames.first) * task.pipelines.size()))
        return;
    std::vector<FaceRange> objects;
    for (const SceneObject& object : scene.objects)
        objects.push_back({object.first_face, object.face_count});

    Input input =
        upload(session.device(), session.queue(), scene.frames[frames.first], scene.faces, objects);
    std::vector<Running> all;
    for (const PipelineChoice& pipeline : task.pipelines)
        all.push_back({pipeline});
    for (std::size_t frame = frames.first; frame < frames.end; ++frame) {
        input.points = scene.frames[frame];
        input.device_points.upload(session.queue().cl(), input.points);
        FrameOfPipelines now{.input = input,
                             .number = task.number + '/' + std::to_string(frame),
                             .scene = facts_of(task, scene, frame)};
        if (frame > frames.first)
            now.motions = object_motions(scene, frame - 1, frame);
        now.file_faces = scene.file_faces;
        Found found;
        std::vector<Cell> cells = run_frame(session, task, all, now, order, found);
        found.scene = &scene;
        add(std::move(cells), found);
    }
}

}  // namespace

void collide_frames(Session& session, const CollideTask& task, int& order,
                    const std::function<void(std::vector<Cell>&&, const Found&)>& add,
                    const std::function<bool(std::size_t cells)>& passes)
{
    const auto collide = [&] {
        (task.swept ? collide_swept : collide_scene)(session, task, order, add, passes);
    };
    if (task.needs_scene) {
        collide();
        return;
    }
    const std::string why = reason_of_failure(collide);
    if (!why.empty() && !(passes && passes(task.pipelines.size())))
        add(skipped_cells(task, why), {});
}

}  // namespace bvhbench
