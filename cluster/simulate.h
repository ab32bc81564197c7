// SPDX-License-Identifier: MIT
#pragma once

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

/// Returns what each of `parts` ranks would do, counted exactly and without running them: this process cuts `whole` into the parts
/// and builds the tree of one part after the other. `boxes`: as in DistributedFrame. Throws what that throws.
std::vector<SimulatedRank> simulated(const Share& whole, PartitionBy by, uint parts, uint boxes,
                                     Programs& programs, Queue& queue, Builder& builder);

}  // namespace bvhbench
