// SPDX-License-Identifier: MIT
//
// The oracle of colliders: the right pairs of boxes, without any tree of ours.
#pragma once

#include "collide/oracles/exact_reference.h"
#include "collide/oracles/wanted_pairs.h"
#include "geometry/moving_query.h"

namespace bvhbench {

/// Which oracle lists the pairs, as results name it: CGAL's boxes, or `brute`, the sweep, in a build without CGAL.
constexpr const char* pairs_oracle = has_exact_reference ? "CGAL boxes" : "brute";

/// Returns every pair of boxes that have a point in common; touching counts. Box k is triangle k. Counts the pairs first, so that
/// host memory is checked before it is taken. Throws Unavailable if it is too small.
PairList overlapping_pairs(std::span<const Aabb> boxes, const WantedPairs& wanted = {});

/// Pads each box by half of `distance`, and a little more, to each side: those of triangles within the distance then overlap.
void pad_boxes(std::span<Aabb> boxes, double distance);

/// As overlapping_pairs, for pairs of triangles that `among` and `filter` accept; without `keep_adjacent`, only without a common vertex.
PairList touching_pairs(std::span<const Aabb> boxes, std::span<const Face> faces,
                        bool keep_adjacent, std::span<const FaceRange> objects = {},
                        Among among = Among::all, const ObjectFilter& filter = {});

/// As above, for the boxes of the triangles in one frame.
PairList touching_pairs(std::span<const Point> points, std::span<const Face> faces,
                        bool keep_adjacent, std::span<const FaceRange> objects = {},
                        Among among = Among::all, const ObjectFilter& filter = {});

/// Returns the pairs of triangles whose boxes in double overlap. Throws Unavailable for 2^24 points or more.
PairList overlapping_pairs_in_doubles(std::span<const WidePoint> points,
                                      std::span<const Face> faces);

/// The same pairs by the hybrid of segment tree and scan in CGAL's package Box_intersection_d [Zomorodian2000], on all cores of the
/// host. Boxes with a NaN, or with a minimum above their maximum, overlap none. Only in builds with CGAL.
PairList pairs_of_cgal(std::span<const Aabb> boxes, const WantedPairs& wanted = {});

}  // namespace bvhbench
