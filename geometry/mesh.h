// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/triangle.h"

namespace bvhbench {

/// Indexed triangle mesh on the host. Triangle k is `faces[k]`; order and duplicates are kept.
struct Mesh {
    std::vector<Point> points;
    std::vector<Face> faces;
};

/// A range of consecutive faces.
struct FaceRange {
    uint first = 0;
    uint count = 0;

    bool operator==(const FaceRange&) const = default;
};

/// Some consecutive triangles of a mesh, and the points that they use.
struct MeshRun {
    std::vector<Face> faces;  ///< corners as numbered in the mesh
    std::vector<Point> points;
    std::vector<uint> vertices;     ///< number of each point in the mesh, ascending
    std::uint64_t mesh_points = 0;  ///< points of the whole mesh
};

/// True if `inner` lies in the closed box `outer`; false if a side of `outer` is not a number.
inline bool contains(const Aabb& outer, const Aabb& inner)
{
    return outer.min_x <= inner.min_x && outer.min_y <= inner.min_y && outer.min_z <= inner.min_z &&
           outer.max_x >= inner.max_x && outer.max_y >= inner.max_y && outer.max_z >= inner.max_z;
}

/// Returns the box of triangle `face`.
inline Aabb face_box(std::span<const Point> points, Face face)
{
    return triangle_box(points[face.a], points[face.b], points[face.c]);
}

/// Returns the box around all `faces`.
inline Aabb box_around(std::span<const Point> points, std::span<const Face> faces)
{
    Aabb box = empty_box();
    for (const Face face : faces)
        box = merged(box, face_box(points, face));
    return box;
}

/// Returns the boxes of all `faces`, in their order.
inline std::vector<Aabb> face_boxes(std::span<const Point> points, std::span<const Face> faces)
{
    std::vector<Aabb> boxes;
    boxes.reserve(faces.size());
    for (const Face face : faces)
        boxes.push_back(face_box(points, face));
    return boxes;
}

}  // namespace bvhbench
