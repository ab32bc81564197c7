// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "builders/builder.h"
#include "cluster/partition.h"
#include "cluster/share.h"

namespace bvhbench {

/// What one rank would send and receive in a frame.
struct SimulatedRank {
    std::uint64_t triangles = 0;
    std::uint64_t halo_sent = 0,
                  halo_received = 0;  ///< triangles, once for each rank that they go to
    std::uint64_t targets = 0;        ///< ranks that it sends triangles to
    std::uint64_t sources = 0;        ///< ranks that send triangles to it
};

/// Cuts a scene into the triangles of each rank, in this process.
std::vector<Share> shares_of(const Share& whole, PartitionBy by, uint parts);

/// Returns what ranks with these shares would do, counted exactly and without running them: builds the tree of one share after the
/// other. `boxes`: as in DistributedFrame. Throws what that throws.
std::vector<SimulatedRank> simulated(std::span<const Share> shares, uint boxes, Programs& programs,
                                     Queue& queue, Builder& builder);

/// Returns the time that the model of docs/cluster.md gives to what ranks tell each other in a frame: waits of the host, the boxes
/// of all others, and the halo of the rank that sends the most. plots/figures/rank_curves.py draws the same model.
std::int64_t exchange_ns(std::span<const SimulatedRank> ranks, uint boxes);

}  // namespace bvhbench
