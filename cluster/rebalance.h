// SPDX-License-Identifier: MIT
//
// Cuts a scene into parts and moves its triangles to their ranks: at first, and again when work is uneven.
#pragma once

#include <span>
#include <vector>

#include "cluster/partition.h"
#include "cluster/share.h"
#include "collide/pairs.h"

namespace bvhbench {

/// Returns the work that each triangle of a share stands for: 1, and 1 for each of the rank's pairs, by scene numbers, that it is in.
std::vector<uint> work_of(const Share& share, std::span<const Pair> pairs);

/// Returns the most work of a rank, divided by the mean. `own`: the work of this rank. All ranks must call.
double imbalance_of(std::uint64_t own, Ranks& ranks);

/// A share after triangles moved between ranks.
struct Cut {
    Share share;
    std::uint64_t left = 0;  ///< triangles that this rank sent to others
};

/// Cuts the scene, of which each rank passes some triangles, and moves them to their ranks. `work` of each triangle: as the weights
/// of PlacedTriangles.
Cut cut(Share share, PartitionBy by, std::span<const uint> work, Ranks& ranks);

}  // namespace bvhbench
