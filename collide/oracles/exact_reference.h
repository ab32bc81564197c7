// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "collide/pairs.h"
#include "geometry/triangle.h"

namespace bvhbench {

/// Whether there is a reference: the build does without CGAL.
constexpr bool has_exact_reference = BVHBENCH_HAS_CGAL != 0;

/// The candidates whose triangles intersect, as collide/narrow/narrow.h says, by CGAL's exact predicates: the oracle that the
/// narrow phase is held to, and none of its code. On one core. Throws Unavailable in a build without CGAL and when the host
/// has not the memory.
PairList intersecting_pairs(std::span<const Point> points, std::span<const Face> faces,
                            const PairList& candidates, bool keep_adjacent);

}  // namespace bvhbench
