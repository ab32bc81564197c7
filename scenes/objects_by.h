// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "scenes/scene.h"

namespace bvhbench {

/// What makes an object of a scene.
enum class ObjectsBy {
    automatic,  ///< as the scene was loaded: a sequence's objects, else the file's meshes, else all is one
    one,         ///< all triangles are one object
    mesh,        ///< as `automatic`, for scenes whose source does name objects
    components,  ///< triangles that name a common vertex, and those that these meet so
};

/// The one called "auto", "one", "mesh" or "components". Throws BadUsage, naming these.
ObjectsBy objects_by_called(std::string_view name);

std::string_view objects_by_name(ObjectsBy by);

/// `scene` with its objects chosen so, finished again (the content hash covers objects).
///
/// Components are in the order of their first triangles, and their triangles are grouped (scenes/face_order.h); those of
/// one object are in the order of the file. Vertices and their numbers stay.
/// Throws BadUsage by `mesh` when the scene's source names no objects.
Scene with_objects(Scene scene, ObjectsBy by);

}  // namespace bvhbench
