// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>

#include "collide/pairs.h"
#include "geometry/mesh.h"

namespace bvhbench {

/// True if a pair of boxes, by their indices, is wanted; an empty function accepts all pairs.
using Wanted = std::function<bool(uint a, uint b)>;

/// Returns every pair of boxes that have a point in common; touching counts. Box k is triangle k.
///
/// The oracle of the trees: single-threaded sweep and prune, without any tree. The boxes are swept along the axis along which
/// they are shortest relative to the extent of all, in strips across the axis that comes second. One sweep counts the pairs, so
/// that host memory is checked first; another one lists them. Throws Unavailable if host memory is too small.
PairList overlapping_pairs(std::span<const Aabb> boxes, const Wanted& wanted = {});

/// As overlapping_pairs, for pairs of triangles that `among` accepts; without `keep_adjacent`, only without a common vertex.
PairList touching_pairs(std::span<const Aabb> boxes, std::span<const Face> faces,
                        bool keep_adjacent, std::span<const FaceRange> objects = {},
                        Among among = Among::all);

/// As above, for the boxes of the triangles in one frame.
PairList touching_pairs(std::span<const Point> points, std::span<const Face> faces,
                        bool keep_adjacent, std::span<const FaceRange> objects = {},
                        Among among = Among::all);

}  // namespace bvhbench
