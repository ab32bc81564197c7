// SPDX-License-Identifier: MIT
#include "harness/measure/frames.h"

#include "geometry/error.h"
#include "scenes/face_order.h"

namespace bvhbench {
namespace {

Scene scene_of(const Experiment& experiment, const std::string& name, const SceneLibrary& library)
{
    return experiment.may_stand_in ? load_or_stand_in(name, library) : load_scene(name, library);
}

}  // namespace

void Frames::load(const Experiment& experiment, const std::string& name,
                  const SceneLibrary& library)
{
    name_ = name;
    scene_ = scene_of(experiment, name, library);
    frame_ = experiment.has(Operation::refit) ? 1 : 0;
    if (frame_ >= scene_.frames.size())
        throw Unavailable("a refit needs a second frame, and scene '" + scene_.name +
                          "' has one; bend:" + scene_.name + " has two");
}

SceneFacts Frames::facts() const
{
    return {.name = name_,
            .triangles = scene_.triangle_count(),
            .vertices = static_cast<std::int64_t>(scene_.frames.front().size()),
            .objects = static_cast<std::int64_t>(scene_.objects.size()),
            .frame = static_cast<std::int64_t>(frame_),
            .source = scene_.source,
            .stand_in_for = scene_.stand_in_for,
            .outlier = scene_.outlier,
            .rounding = scene_.rounding,
            .bend_of = scene_.bend_of,
            .content_hash = scene_.content_hash};
}

void Frames::upload(Session& session, bool by_objects)
{
    std::vector<FaceRange> objects;
    if (by_objects)
        for (const SceneObject& object : scene_.objects)
            objects.push_back({object.first_face, object.face_count});
    else if (!scene_.file_faces.empty())
        file_faces_ = faces_in_file(scene_);
    const std::vector<Face>& faces = file_faces_.empty() ? scene_.faces : file_faces_;
    const auto on_device = [&](std::size_t frame) {
        return bvhbench::upload(session.device(), session.queue(), scene_.frames[frame], faces,
                                objects);
    };
    now_ = on_device(frame_);
    if (frame_ > 0)
        before_ = on_device(frame_ - 1);
}

}  // namespace bvhbench
