// SPDX-License-Identifier: MIT
//
// The part of a triangle inside a box, in double.
#pragma once

#include <span>

#include "geometry/mesh.h"

namespace bvhbench {

/// A flat convex polygon of at most nine corners: a triangle, cut by six planes.
struct Polygon {
    struct Corner {
        double axis[3];
    };
    Corner corners[9] = {};
    int count = 0;
};

Polygon polygon_of(std::span<const Point> points, Face face);

/// What of `polygon` is in the closed box: a triangle in one of its faces is inside.
Polygon clipped(const Polygon& polygon, const Aabb& box);

/// 0 for less than three corners.
double area(const Polygon& polygon);

}  // namespace bvhbench
