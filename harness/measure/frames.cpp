// SPDX-License-Identifier: MIT
#include "harness/measure/frames.h"

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

}  // namespace bvhbench
