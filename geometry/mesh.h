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

/// The boxes of all of `faces`.
inline std::vector<Aabb> face_boxes(std::span<const Point> points, std::span<const Face> faces)
{
    std::vector<Aabb> boxes;
    boxes.reserve(faces.size());
    for (const Face face : faces)
        boxes.push_back(face_box(points, face));
    return boxes;
}

}  // namespace bvhbench
