// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "collide/pairs.h"
#include "geometry/mesh.h"

namespace bvhbench {

/// Every pair of boxes that share a point; touching counts. Box k is triangle k.
///
/// Sweep and prune on one core, without any tree: the oracle that trees are held to. Takes O(n log n) and
/// one test for each pair of boxes that overlap along the axis swept, the longest.
PairList overlapping_pairs(std::span<const Aabb> boxes);

/// The same of the boxes of triangles; without `keep_adjacent`, only pairs that share no vertex index.
PairList touching_pairs(std::span<const Point> points, std::span<const Face> faces,
                        bool keep_adjacent);

/// Bytes of the host's memory that a sweep takes besides the pairs that it finds.
constexpr std::size_t sweep_bytes(std::size_t boxes)
{
    return boxes * (2 * sizeof(Aabb) + sizeof(uint));
}

}  // namespace bvhbench
