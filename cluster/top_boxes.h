// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "builders/device_tree.h"
#include "cluster/halo.h"
#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"

namespace bvhbench {

/// Reads the boxes that a rank tells the others from its tree.
class TopBoxes {
public:
    /// `count`: how many boxes; a power of two.
    TopBoxes(Programs& programs, uint count) : programs_(programs), count_(count) {}

    /// Compiles for trees like `tree`, which has at least two leaves, and reserves memory. Never timed. Throws Unavailable,
    /// and BadUsage if no level of these trees has as many nodes.
    void reserve(const DeviceTree& tree);

    /// Returns the boxes of the tree that the last build in `queue` made, in the stage `top`; empty ones if it has fewer
    /// nodes on that level. They are exact if the tree's are. Waits.
    std::vector<Aabb> read(const DeviceTree& tree, Queue& queue);

private:
    Programs& programs_;
    uint count_;
    cl::Kernel kernel_;
    std::optional<Arena> arena_;
    Buffer<Aabb> boxes_;
};

}  // namespace bvhbench
