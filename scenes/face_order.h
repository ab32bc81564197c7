// SPDX-License-Identifier: MIT
//
// Grouping of triangles by object. An object of a scene is a range of consecutive triangles, but a file may store triangles in
// any order. They are grouped when the file is read, and `Scene::file_faces` keeps their numbers in the file.
#pragma once

#include <span>
#include <string_view>

#include "scenes/scene.h"

namespace bvhbench {

/// Sorts triangles by `object_of_face`, the index of each triangle's object in `scene.objects`; triangles of one object keep
/// their order. Sets the ranges of the objects, which must already have their names. If no triangle has to move, `file_faces`
/// is left unchanged.
void group_faces(Scene& scene, std::span<const uint> object_of_face);

/// As group_faces, with the connected components as objects, in the order of their first triangles.
void group_by_parts(Scene& scene);

/// Returns the triangles in the order of the file.
std::vector<Face> faces_in_file(const Scene& scene);

/// Returns, for each triangle in the order of the file, the number that the file gives its object.
std::vector<std::int64_t> objects_in_file(const Scene& scene);

/// Returns `scene` for algorithms that treat all triangles as one object: with the triangles in the order of the file. If
/// grouping had moved triangles, the result has one object; otherwise the scene is unchanged.
Scene in_file_order(Scene scene);

/// Criterion by which a scene is divided into objects.
enum class ObjectsBy {
    automatic,  ///< as loaded: the objects of a sequence, else the meshes of the file, else one object
    one,        ///< all triangles are one object
    mesh,       ///< as `automatic`, only for scenes whose source names objects
    components,  ///< connected components: triangles that share a vertex index, transitively
    groups,      ///< groups that the file names beside its objects: OBJ's "g"
};

/// Returns the criterion called "auto", "one", "mesh", "components" or "groups". Throws BadUsage, listing these, for any other name.
ObjectsBy objects_by_called(std::string_view name);

std::string_view objects_by_name(ObjectsBy by);

/// Returns `scene` divided into objects by `by`, finished again (the content hash covers objects).
///
/// Components are in the order of their first triangles, and their triangles are grouped; the triangles of one object are in
/// the order of the file. Vertices and their indices are unchanged. Throws BadUsage for `mesh` if the source names no objects, and for
/// `groups` if it names no groups.
Scene with_objects(Scene scene, ObjectsBy by);

}  // namespace bvhbench
