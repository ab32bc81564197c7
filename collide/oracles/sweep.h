// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "collide/oracles/wanted_pairs.h"

namespace bvhbench {

/// Returns every pair of boxes that have a point in common; touching counts. Box k is triangle k.
///
/// Single-threaded sweep and prune, without any tree: the collider `brute`, and the oracle of pairs where CGAL is missing. The
/// boxes are swept along the axis along which they are shortest relative to the extent of all, in strips across the axis that
/// comes second. One sweep counts the pairs, so that host memory is checked first; another one lists them. Throws Unavailable if
/// host memory is too small.
PairList swept_pairs(std::span<const Aabb> boxes, const WantedPairs& wanted = {});

}  // namespace bvhbench
