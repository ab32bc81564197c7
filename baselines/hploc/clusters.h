// SPDX-License-Identifier: MIT
//
// What host and device must agree on to build the tree of `hploc`.
//
// A range is a node of the radix tree: neighbouring leaves. It comes as a list of clusters, subtrees whose leaves may be
// interleaved. A range of at most RANGE_CLUSTERS leaves comes as its leaves. Any other is the list of its left child followed by
// that of its right child, shortened in rounds until RANGE_CLUSTERS are left, or one where the range is an object's leaves:
//
//     round     each cluster chooses, among the SEARCH_RADIUS before and behind it, the one with the smallest cluster_key;
//               two that choose each other become one, in the place of the first
//
//     places    0   1   2   3   4           0 and 2 choose each other: the new cluster stands at 0, what was
//                \_____/                    behind 2 moves up, and there are four places
//
// The key is a total order on the pairs of one cluster, and the same for both of a pair. So the pair with the smallest key of all
// is always joined, and a round never leaves the list as it was. Of equal areas the key prefers the places that differ in the
// lowest bits: places 2k and 2k + 1 first. So equal boxes are joined by pairs, to a balanced tree.
#ifndef BVHBENCH_BASELINES_HPLOC_CLUSTERS_H
#define BVHBENCH_BASELINES_HPLOC_CLUSTERS_H

#include "geometry/aabb.h"

// Other values make other trees, so these are no tuning parameters. A list of two children has MOST_CLUSTERS places at most. The
// radius of [Benthin2024] is 8; with 4 the surface of six scenes is 0.984 to 1.008 of that, and each round takes less.
#define SEARCH_RADIUS 4u
#define RANGE_CLUSTERS 16u
#define MOST_CLUSTERS 32u
#define NO_KEY 0xffffffffu

SHARED_BEGIN

/// Returns the key of the clusters with boxes `a` and `b` at places i and j, below NO_KEY: the surface area of the box around
/// both, rounded down to 18 bits behind the leading one, and then i ^ j. Areas beyond the largest float are equal.
SHARED_FN_INLINED uint cluster_key(Aabb a, Aabb b, uint i, uint j)
{
    const float area = fmin(half_surface(merged(a, b)), as_float(0x7f800000u));
    return (as_uint(area) & ~(MOST_CLUSTERS - 1u)) | (i ^ j);
}

/// Returns the place j of a key of place i.
SHARED_FN_INLINED uint partner_of(uint key, uint i) { return i ^ (key & (MOST_CLUSTERS - 1u)); }

SHARED_END

#endif
