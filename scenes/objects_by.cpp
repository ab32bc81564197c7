// SPDX-License-Identifier: MIT
#include "scenes/objects_by.h"

#include <utility>

#include "geometry/error.h"
#include "scenes/face_order.h"
#include "scenes/finish.h"

namespace bvhbench {
namespace {

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

std::string_view objects_by_name(ObjectsBy by)
{
    for (const auto& [name, known] : names)
        if (by == known)
            return name;
    return "";
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
            scene.object_ids.clear();
            scene = in_file_order(std::move(scene));
            break;
        case ObjectsBy::components:
            group_by_parts(scene);
            break;
    }
    scene.has_meshes = false;
    return finished(std::move(scene));
}

}  // namespace bvhbench
