// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "cluster/partition.h"
#include "cluster/share.h"
#include "collide/pairs.h"

namespace bvhbench {

/// Returns the work that each triangle of a share stands for: 1, and 1 for each of the rank's pairs, by scene numbers, that it is in.
std::vector<uint> work_of(const Share& share, std::span<const Pair> pairs);

/// A share after triangles moved between ranks.
struct Rebalanced {
    Share share;
    std::uint64_t left = 0;  ///< triangles that this rank sent to others
};

/// Cuts the scene anew with `rcb`, so that all ranks have about as much work, and moves triangles to their ranks.
Rebalanced rebalanced(const Share& share, std::span<const uint> work, Ranks& ranks);

}  // namespace bvhbench
