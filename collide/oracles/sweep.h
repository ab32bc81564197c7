// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>

#include "collide/pairs.h"
#include "geometry/mesh.h"

namespace bvhbench {

/// Whether a pair of boxes is wanted, by their numbers; an empty one wants all.
using Wanted = std::function<bool(uint a, uint b)>;

/// Every pair of boxes that share a point; touching counts. Box k is triangle k.
///
/// Sweep and prune on one core, without any tree: the oracle that trees are held to. The boxes are swept along the axis on
/// which they are shortest for the extent of all, in strips across the next such axis. It sweeps twice: once to count,
/// so that memory is asked for before it is taken, and once to list. Throws Unavailable when the host has not enough.
PairList overlapping_pairs(std::span<const Aabb> boxes, const Wanted& wanted = {});

/// The same of triangles that lie among `objects` so; without `keep_adjacent`, only pairs that share no vertex index.
PairList touching_pairs(std::span<const Aabb> boxes, std::span<const Face> faces,
                        bool keep_adjacent, std::span<const FaceRange> objects = {},
                        Among among = Among::all);

/// Of the boxes that the triangles have in one frame.
PairList touching_pairs(std::span<const Point> points, std::span<const Face> faces,
                        bool keep_adjacent, std::span<const FaceRange> objects = {},
                        Among among = Among::all);

}  // namespace bvhbench
