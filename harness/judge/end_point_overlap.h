// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <span>

#include "builders/tree.h"
#include "geometry/mesh.h"
#include "harness/judge/metrics.h"

namespace bvhbench {

/// Returns the end-point overlap (EPO): the share of the surface that lies in nodes it does not belong to,
///
///     EPO := sum over nodes n of C_n A((S \ Q(n)) cut with n) / A(S),
///
/// where S is all triangles and Q(n) those below n (Aila, Karras, Laine 2013, Sec. 3). SAH counts boxes that any ray might hit;
/// EPO counts boxes that contain a point of the surface without need. The EPO is the cost() of the returned sums. Returns
/// nothing if all triangles together have no area.
///
/// Each triangle descends from the root while part of it is in the box, and is clipped to each box in double. `threads` = 0 uses
/// all threads of the host; their number does not change a bit of the sums.
std::optional<AreaSums> end_point_overlap(const HostTree& tree, std::span<const Point> points,
                                          std::span<const Face> faces, unsigned threads = 0);

/// A triangle clipped by axis-aligned planes, in double: a flat convex polygon and its bounding box.
struct Polygon {
    using Corner = std::array<double, 3>;
    /// Three, one more for each of six planes, and spare ones for edges bent by rounding.
    static constexpr int most_corners = 12;

    int count = 0;
    Corner corners[most_corners];
    Corner low, high;  ///< bounds of the corners, if there are any
};

Polygon polygon_of(std::span<const Point> points, Face face);

/// Writes to `left`, a different polygon, the part of `polygon` in the closed box. A triangle in a face of the box is inside.
void clip(const Polygon& polygon, const Aabb& box, Polygon& left);

/// Returns 0 for less than three corners.
double area(const Polygon& polygon);

}  // namespace bvhbench
