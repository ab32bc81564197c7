// SPDX-License-Identifier: MIT
#include "scenes/face_order.h"

#include <algorithm>

#include "scenes/finish.h"
#include "scenes/parts.h"

namespace bvhbench {
namespace {

template <class T>
std::vector<T> taken(const std::vector<T>& values, const std::vector<uint>& from)
{
    std::vector<T> result;
    result.reserve(from.size());
    for (const uint k : from)
        result.push_back(values[k]);
    return result;
}

}  // namespace

void group_faces(Scene& scene, std::span<const uint> object_of_face)
{
    for (SceneObject& object : scene.objects)
        object.face_count = 0;
    for (const uint object : object_of_face)
        ++scene.objects[object].face_count;
    std::vector<uint> next;  // of each object, the place of its next triangle
    uint first = 0;
    for (SceneObject& object : scene.objects) {
        object.first_face = first;
        next.push_back(first);
        first += object.face_count;
    }
    if (std::ranges::is_sorted(object_of_face))
        return;
    std::vector<uint> from(object_of_face.size());
    for (uint k = 0; k < from.size(); ++k)
        from[next[object_of_face[k]]++] = k;
    scene.faces = taken(scene.faces, from);
    scene.file_faces = scene.file_faces.empty() ? std::move(from) : taken(scene.file_faces, from);
}

void group_by_parts(Scene& scene)
{
    const Parts parts = parts_of(scene.faces, scene.frames.front().size());
    scene.objects.clear();
    for (uint part = 0; part < parts.count; ++part)
        scene.objects.push_back({"part " + std::to_string(part), 0, 0});
    scene.object_ids.clear();
    group_faces(scene, parts.of_face);
}

std::vector<Face> faces_in_file(const Scene& scene)
{
    std::vector<Face> faces = scene.faces;
    for (std::size_t k = 0; k < scene.file_faces.size(); ++k)
        faces[scene.file_faces[k]] = scene.faces[k];
    return faces;
}

std::vector<std::int64_t> objects_in_file(const Scene& scene)
{
    std::vector<std::int64_t> objects(scene.faces.size());
    for (std::size_t object = 0; object < scene.objects.size(); ++object) {
        const auto [name, first, count] = scene.objects[object];
        const std::int64_t id =
            scene.object_ids.empty() ? static_cast<std::int64_t>(object) : scene.object_ids[object];
        for (std::size_t k = first; k < std::size_t{first} + count; ++k)
            objects[scene.file_faces.empty() ? k : scene.file_faces[k]] = id;
    }
    return objects;
}

Scene in_file_order(Scene scene)
{
    if (scene.file_faces.empty())
        return scene;
    scene.faces = faces_in_file(scene);
    scene.file_faces.clear();
    scene.objects.clear();  // finishing makes it one
    scene.object_ids.clear();
    scene.has_meshes = false;
    return finished(std::move(scene));
}

}  // namespace bvhbench
