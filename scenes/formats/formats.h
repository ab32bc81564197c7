// SPDX-License-Identifier: MIT
//
// Readers of the four plain formats. assimp is not used for these: it gives every corner of an OBJ face a separate vertex, so
// that neighbours share none; it accepts some files that are truncated or name missing vertices; and it ignores the object ids
// of a PLY file.
//
// All four keep the order of vertices and faces, merge nothing, and cut a polygon into a fan around its first corner. They
// throw Unavailable, in one sentence that begins with `name`, for any content that they do not understand, and drop no face.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scenes/formats/text.h"
#include "scenes/scene.h"

namespace bvhbench {

/// Contents of a mesh file, with the faces in the order of the file. Without objects, all faces are one object.
struct FileMesh {
    Mesh mesh;
    std::vector<SceneObject> objects;
    /// Index in `objects` of the object of each face; empty: objects are consecutive ranges of faces.
    std::vector<uint> object_of_face = {};
    /// Numbers of the objects in the file; empty: 0, 1, ...
    std::vector<std::int64_t> object_ids = {};
    /// The same vertices in double precision. Empty if `has_doubles` is false, as for a file whose numbers are floats; the
    /// reader sets `has_doubles` before it adds points.
    std::vector<WidePoint> wide = {};
    bool has_doubles = true;
    /// True if floats hold every coordinate of the file: a double equals its float, or a text has no further digits.
    bool floats_hold = true;

    void add_point(const FileNumber& x, const FileNumber& y, const FileNumber& z);

    /// Cuts a polygon into a fan around its first corner.
    void add_polygon(const std::vector<uint>& corners);

    /// Makes the faces from `first` on into an object, if there are any.
    void add_object(std::string_view name, std::size_t first);
};

/// Wavefront OBJ: v and f lines, relative indices, continued lines. "o" begins an object.
FileMesh read_obj(std::string_view bytes, const std::string& name);

/// PLY, ascii and binary of either byte order. Faces with the same integer property `object_id` form an object, wherever they
/// are in the file. Objects are ordered by their ids.
FileMesh read_ply(std::string_view bytes, const std::string& name);

/// OFF and its variants with colours or normals after the three coordinates. Binary OFF is not supported.
FileMesh read_off(std::string_view bytes, const std::string& name);

/// STL, binary or ascii. Each triangle has three vertices, as stored; each solid is an object.
FileMesh read_stl(std::string_view bytes, const std::string& name);

}  // namespace bvhbench
