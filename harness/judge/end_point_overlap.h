// SPDX-License-Identifier: MIT
#pragma once

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

}  // namespace bvhbench
