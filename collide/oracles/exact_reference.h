// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <span>

#include "collide/pairs.h"
#include "geometry/triangle.h"

namespace bvhbench {

/// True if the build includes CGAL, and with it the reference.
constexpr bool has_exact_reference = BVHBENCH_HAS_CGAL != 0;

/// How many candidates an exact reference has checked. Other threads may read it meanwhile.
struct Checked {
    std::atomic<std::size_t> all = 0;
    std::atomic<std::size_t> by_roots = 0;  ///< those between frames that took roots of polynomials
};

/// Returns the candidates whose triangles intersect, as defined in collide/narrow/narrow.h, by CGAL's exact predicates: the
/// oracle of the narrow phase, independent of its code. Counts in `checked`, if given. Uses all host cores. Throws Unavailable without CGAL
/// or with too little host memory.
PairList intersecting_pairs(std::span<const Point> points, std::span<const Face> faces,
                            std::span<const Pair> candidates, bool keep_adjacent,
                            Checked* checked = nullptr);

/// Returns the candidates whose triangles are at most `distance` apart, as defined in collide/within/within.h, by CGAL's exact
/// predicates and numbers; otherwise as above.
PairList pairs_within(std::span<const Point> points, std::span<const Face> faces,
                      std::span<const Pair> candidates, bool keep_adjacent, double distance,
                      Checked* checked = nullptr);

}  // namespace bvhbench
