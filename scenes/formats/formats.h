// SPDX-License-Identifier: MIT
//
// Readers of the five formats that this program reads itself. assimp is not used for these: it gives every corner of an OBJ face
// a separate vertex, so that neighbours share none; it accepts some files that are truncated or name missing vertices; it ignores
// the object ids of a PLY file; and it ignores what a glTF file says that a reader must understand.
//
// All keep the order of vertices and faces and merge nothing. They throw Unavailable, in one sentence that begins with `name`, for
// any content that they do not understand, and drop no face. What is no triangle and is passed over is listed in
// `FileMesh::reading`.
#pragma once

#include <functional>
#include <map>
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
    /// Names of groups, a second division into objects, and the index of each face's group; empty: the file has none.
    std::vector<std::string> groups = {};
    std::vector<uint> group_of_face = {};
    std::vector<FaceRange> polygons = {};  ///< fans of more than one face, for cut_polygons
    Reading reading = {};

    void add_point(const FileNumber& x, const FileNumber& y, const FileNumber& z);

    /// Adds a polygon as a fan around its first corner. cut_polygons cuts it otherwise where that is wrong.
    void add_polygon(const std::vector<uint>& corners);

    /// Makes the faces from `first` on into an object, if there are any.
    void add_object(std::string_view name, std::size_t first);
};

/// Replaces the fans of polygons that a fan does not cover by triangles that do, as many. All points must be there. Throws
/// Unavailable for such a polygon with too many corners.
void cut_polygons(FileMesh& file, const std::string& name);

/// Adds "2 lines 'vp'" to what was ignored, for each word and its number.
void list_ignored(const std::map<std::string, std::size_t>& counts, const std::string& of,
                  Reading& reading);

/// Returns a text without the byte order mark of UTF-8. Throws Unavailable for UTF-16.
std::string_view without_mark(std::string_view bytes, const std::string& name);

/// Wavefront OBJ: v and f lines, relative indices, continued lines. "o" begins an object, "g" a group.
FileMesh read_obj(std::string_view bytes, const std::string& name);

/// PLY, ascii and binary of either byte order: faces and triangle strips. Faces with the same integer property `object_id` form an object, wherever they
/// are in the file. Objects are ordered by their ids.
FileMesh read_ply(std::string_view bytes, const std::string& name);

/// OFF and its variants with colours or normals after the three coordinates. Binary OFF is not supported.
FileMesh read_off(std::string_view bytes, const std::string& name);

/// STL, binary or ascii. Each triangle has three vertices, as stored; each solid is an object.
FileMesh read_stl(std::string_view bytes, const std::string& name);

/// Returns the bytes of a file that is named by its path relative to another one.
using ReadBeside = std::function<std::string(const std::string& path)>;

/// glTF 2.0, as JSON (.gltf) or binary (.glb). Each instance of a mesh is an object, placed by
/// the nodes above it in double precision; morph weights and skins are applied in their default pose. Vertices that no face names
/// are left out. Throws Unavailable for an extension that the file requires and that is not read.
FileMesh read_gltf(std::string_view bytes, const std::string& name, const ReadBeside& read_beside);

}  // namespace bvhbench
