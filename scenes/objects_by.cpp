// SPDX-License-Identifier: MIT
#include "scenes/objects_by.h"

#include <iterator>

#include "geometry/error.h"
#include "scenes/finish.h"
#include "scenes/parts.h"

namespace bvhbench {
namespace {

/// The triangles by part, each part's as they were: where each place's triangle came from.
std::vector<uint> order_by_part(const Parts& parts)
{
    std::vector<uint> next(parts.count + std::size_t{1}, 0);
    for (const uint part : parts.of_face)
        ++next[part + 1];
    for (uint part = 0; part < parts.count; ++part)
        next[part + 1] += next[part];
    std::vector<uint> from(parts.of_face.size());
    for (uint k = 0; k < from.size(); ++k)
        from[next[parts.of_face[k]]++] = k;
    return from;
}

bool is_identity(const std::vector<uint>& order)
{
    for (uint k = 0; k < order.size(); ++k)
        if (order[k] != k)
            return false;
    return true;
}

template <class T>
std::vector<T> taken(const std::vector<T>& values, const std::vector<uint>& from)
{
    std::vector<T> result;
    result.reserve(from.size());
    for (const uint k : from)
        result.push_back(values[k]);
    return result;
}

void divide_by_component(Scene& scene)
{
    const Parts parts = parts_of(scene.faces, scene.frames.front().size());
    std::vector<uint> from = order_by_part(parts);
    if (!is_identity(from)) {
        scene.faces = taken(scene.faces, from);
        scene.file_faces =
            scene.file_faces.empty() ? std::move(from) : taken(scene.file_faces, from);
    }
    scene.objects = connected_parts(scene.faces, scene.frames.front().size());
}

constexpr std::pair<const char*, ObjectsBy> names[] = {
    {"auto", ObjectsBy::automatic},
    {"one", ObjectsBy::one},
    {"mesh", ObjectsBy::mesh},
    {"components", ObjectsBy::components},
};

}  // namespace

ObjectsBy objects_by_called(std::string_view name)
{
    for (const auto& [known, by] : names)
        if (name == known)
            return by;
    throw BadUsage("objects are chosen by auto, one, mesh or components, not by '" +
                   std::string(name) + "'");
}

Scene with_objects(Scene scene, ObjectsBy by)
{
    switch (by) {
        case ObjectsBy::automatic:
            return scene;
        case ObjectsBy::mesh:
            if (!scene.has_meshes)
                throw BadUsage(
                    "scene '" + scene.name +
                    "' has no meshes to take for objects: what it was made from names none");
            return scene;
        case ObjectsBy::one:
            scene.objects.clear();  // finishing makes it one
            break;
        case ObjectsBy::components:
            divide_by_component(scene);
            break;
    }
    scene.has_meshes = false;
    return finished(std::move(scene));
}

}  // namespace bvhbench
