// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "collide/pairs.h"
#include "geometry/triangle.h"

namespace bvhbench {

/// True if the build includes CGAL, and with it the reference.
constexpr bool has_exact_reference = BVHBENCH_HAS_CGAL != 0;

/// Returns the candidates whose triangles intersect, as defined in collide/narrow/narrow.h, by CGAL's exact predicates: the
/// oracle of the narrow phase, independent of its code. Uses all host cores. Throws Unavailable without CGAL or with too little host
/// memory.
PairList intersecting_pairs(std::span<const Point> points, std::span<const Face> faces,
                            std::span<const Pair> candidates, bool keep_adjacent);

}  // namespace bvhbench
