// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "geometry/triangle.h"

namespace bvhbench {

/// An indexed triangle mesh on the host. Triangle k is `faces[k]`; order and duplicates are kept as given.
struct Mesh {
    std::vector<Point> points;
    std::vector<Face> faces;
};

/// Triangles that belong together: a run of neighbouring faces.
struct FaceRange {
    uint first = 0;
    uint count = 0;

    bool operator==(const FaceRange&) const = default;
};

/// The box of triangle `face` of `points`.
inline Aabb face_box(std::span<const Point> points, Face face)
{
    return triangle_box(points[face.a], points[face.b], points[face.c]);
}

}  // namespace bvhbench
