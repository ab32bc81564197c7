// SPDX-License-Identifier: MIT
//
// The four plain formats, read here and not by assimp: assimp gives every corner of an OBJ face a vertex
// of its own, so that neighbours no longer share any, reads some files that are cut short or name vertices
// that are not there as if they were sound, and ignores the object ids of a PLY file.
//
// All four keep the order of vertices and faces, merge nothing, and cut a polygon into a fan round its
// first corner. They throw Unavailable, in one sentence that begins with `name`, at anything they do not
// understand in full; they drop no face.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scenes/formats/text.h"
#include "scenes/scene.h"

namespace bvhbench {

/// What a mesh file holds, with the faces in its order. Without objects, all faces are one.
struct FileMesh {
    Mesh mesh;
    std::vector<SceneObject> objects;
    /// The place in `objects` of each face's; empty: objects are runs of faces, one after the other.
    std::vector<uint> object_of_face = {};
    /// The file's numbers of the objects; empty: 0, 1, ...
    std::vector<std::int64_t> object_ids = {};
    /// The same vertices as the file has them; empty of a file whose numbers are floats, which must say so first.
    std::vector<WidePoint> wide = {};
    bool has_doubles = true;
    /// Whether the floats of `mesh` are all that the file says: a double is one, or a text has no digits that differ.
    bool floats_hold = true;

    void add_point(const FileNumber& x, const FileNumber& y, const FileNumber& z);

    /// Cuts a polygon into a fan round its first corner.
    void add_polygon(const std::vector<uint>& corners);

    /// Makes the faces from `first` on an object, if there are any.
    void add_object(std::string_view name, std::size_t first);
};

/// Wavefront OBJ: v and f lines, relative indices, continued lines; "o" begins an object.
FileMesh read_obj(std::string_view bytes, const std::string& name);

/// PLY, ascii and binary of either byte order. Faces with the same integer property `object_id` are an object, wherever they
/// are in the file; objects are in the order of their ids.
FileMesh read_ply(std::string_view bytes, const std::string& name);

/// OFF and its variants with colours or normals after the three coordinates; not binary.
FileMesh read_off(std::string_view bytes, const std::string& name);

/// STL, binary or ascii. Three vertices a triangle, as stored; each solid is an object.
FileMesh read_stl(std::string_view bytes, const std::string& name);

}  // namespace bvhbench
