// SPDX-License-Identifier: MIT
#include "harness/measure/frames.h"

#include "geometry/error.h"
#include "scenes/face_order.h"

namespace bvhbench {

Scene scene_called(const std::string& name, bool may_stand_in, const SceneLibrary& library)
{
    return may_stand_in ? load_or_stand_in(name, library) : load_scene(name, library);
}

SceneFacts facts_of(const Scene& scene, std::string name, std::size_t frame)
{
    return {.name = std::move(name),
            .triangles = scene.triangle_count(),
            .vertices = static_cast<std::int64_t>(scene.frames.front().size()),
            .objects = static_cast<std::int64_t>(scene.objects.size()),
            .frame = static_cast<std::int64_t>(frame),
            .source = scene.source,
            .stand_in_for = scene.stand_in_for,
            .outlier = scene.outlier,
            .rounding = scene.rounding,
            .bend_of = scene.bend_of,
            .mesh = scene.facts,
            .reading = scene.reading,
            .content_hash = scene.content_hash};
}

Input upload_frame(Session& session, const Scene& scene, std::size_t frame, bool by_objects)
{
    std::vector<FaceRange> objects;  // empty: one object
    for (const SceneObject& object : scene.objects)
        if (by_objects)
            objects.push_back({object.first_face, object.face_count});
    return upload(session.device(), session.queue(), scene.frames[frame], scene.faces, objects);
}

void Frames::load(const Experiment& experiment, const std::string& name,
                  const SceneLibrary& library)
{
    scene_ = scene_called(name, experiment.may_stand_in, library);
    frame_ = experiment.has(Operation::refit) ? 1 : 0;
    if (frame_ >= scene_.frames.size())
        throw Unavailable("a refit needs a second frame, and scene '" + scene_.name +
                          "' has one; bend:" + scene_.name + " has two");
    facts_ = facts_of(scene_, name, frame_);
}

void Frames::upload(Session& session)
{
    scene_ = in_file_order(std::move(scene_));
    now_ = upload_frame(session, scene_, frame_, false);
    if (frame_ > 0)
        before_ = upload_frame(session, scene_, frame_ - 1, false);
}

void Frames::upload_points(Session& session)
{
    now_.device_points.upload(session.queue().cl(), now_.points);
}

}  // namespace bvhbench
