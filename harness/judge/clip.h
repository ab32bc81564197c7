// SPDX-License-Identifier: MIT
//
// The part of a triangle inside a box, in double.
#pragma once

#include <span>

#include "geometry/mesh.h"

namespace bvhbench {

/// A flat convex polygon, what planes along the axes left of a triangle, and the box around it.
struct Polygon {
    struct Corner {
        double axis[3];
    };
    /// Three, and one more for each of six planes; the rest is for edges that rounding bends.
    static constexpr int most_corners = 12;

    int count = 0;
    Corner corners[most_corners];
    double low[3], high[3];  ///< of corners, if there are any
};

Polygon polygon_of(std::span<const Point> points, Face face);

/// Whether the closed box and the one around the polygon share a point.
inline bool overlap(const Aabb& box, const Polygon& polygon)
{
    return box.min_x <= polygon.high[0] && polygon.low[0] <= box.max_x &&
           box.min_y <= polygon.high[1] && polygon.low[1] <= box.max_y &&
           box.min_z <= polygon.high[2] && polygon.low[2] <= box.max_z;
}

/// Whether all of the polygon is in the closed box.
inline bool contains(const Aabb& box, const Polygon& polygon)
{
    return box.min_x <= polygon.low[0] && polygon.high[0] <= box.max_x &&
           box.min_y <= polygon.low[1] && polygon.high[1] <= box.max_y &&
           box.min_z <= polygon.low[2] && polygon.high[2] <= box.max_z;
}

/// Into `left`, another polygon, what of `polygon` is in the closed box: a triangle in one of its faces is inside.
void clip(const Polygon& polygon, const Aabb& box, Polygon& left);

/// 0 for less than three corners.
double area(const Polygon& polygon);

}  // namespace bvhbench
