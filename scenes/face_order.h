// SPDX-License-Identifier: MIT
//
// An object of a scene is a run of triangles. Files may have the triangles of their objects in any order: they are grouped
// when they are read, and `Scene::file_faces` keeps the numbers that they have in the file.
#pragma once

#include <span>
#include <string_view>

#include "scenes/scene.h"

namespace bvhbench {

/// Makes each object a run: triangles are sorted by `object_of_face`, the place of each one's object in `scene.objects`, and
/// those of one object keep their order. Sets the ranges of the objects, whose names must be there. Where nothing has to
/// move, `file_faces` stays as it is.
void group_faces(Scene& scene, std::span<const uint> object_of_face);

/// The same, with connected parts as objects, in the order of their first triangles.
void group_by_parts(Scene& scene);

/// The triangles in the order of the file.
std::vector<Face> faces_in_file(const Scene& scene);

/// The number that the file gives each triangle's object, by the number that it gives the triangle.
std::vector<std::int64_t> objects_in_file(const Scene& scene);

/// `scene` for those that take all triangles as one object: with the triangles in the order of the file. Where grouping had
/// moved them, there is one object then; else the scene stays as it is.
Scene in_file_order(Scene scene);

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
/// Components are in the order of their first triangles, and their triangles are grouped; those of
/// one object are in the order of the file. Vertices and their numbers stay.
/// Throws BadUsage by `mesh` when the scene's source names no objects.
Scene with_objects(Scene scene, ObjectsBy by);

}  // namespace bvhbench
