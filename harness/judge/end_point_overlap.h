// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <span>

#include "builders/tree.h"
#include "geometry/mesh.h"
#include "harness/judge/metrics.h"

namespace bvhbench {

/// End-point overlap: how much surface lies in nodes that it does not belong to,
///
///     EPO := sum over nodes n of C_n A((S \ Q(n)) cut with n) / A(S),
///
/// S all triangles, Q(n) those below n (Aila, Karras, Laine 2013, Sec. 3). Where the surface area cost counts
/// boxes that any ray might meet, this counts those that a point of the surface is in without need.
/// It is the cost of the sums given here. Nothing if all triangles together have no area.
///
/// Every triangle descends from the root while some of it is in the box, and is cut to the box exactly, on as
/// many threads as asked for, or as the host has. Their number does not change a bit of the sums.
std::optional<AreaSums> end_point_overlap(const HostTree& tree, std::span<const Point> points,
                                          std::span<const Face> faces, unsigned threads = 0);

/// What planes along the axes left of a triangle, in double: a flat convex polygon, and the box around it.
struct Polygon {
    using Corner = std::array<double, 3>;
    /// Three, and one more for each of six planes; the rest is for edges that rounding bends.
    static constexpr int most_corners = 12;

    int count = 0;
    Corner corners[most_corners];
    Corner low, high;  ///< of corners, if there are any
};

Polygon polygon_of(std::span<const Point> points, Face face);

Polygon polygon_of(std::span<const Point> points, Face face);

/// Into `left`, another polygon, what of `polygon` is in the closed box: a triangle in one of its faces is inside.
void clip(const Polygon& polygon, const Aabb& box, Polygon& left);

/// 0 for less than three corners.
double area(const Polygon& polygon);

}  // namespace bvhbench
