// SPDX-License-Identifier: MIT
#pragma once

#include "builders/implicit/layout.h"
#include "geometry/aabb.h"

namespace bvhbench {

/// A box in a format whose sides are not floats.
template <class Side>
struct BoxOf {
    Side low[3], high[3];
};

/// An implicit tree in the host's memory, of a layout without padding: see ImplicitTree. Its boxes are Aabb, or BoxOf
/// doubles, 16 or 8 bits.
template <class Box>
struct HostLevels {
    ImplicitLayout layout;
    uint leaves = 0;
    Box* nodes = nullptr;  ///< by slot
    const Box* leaf_boxes =
        nullptr;                ///< in mesh order; null if leaves are in `nodes`, in leaf order
    const uint* ids = nullptr;  ///< triangles in leaf order

    /// Build from the leaves to the node at `position` of `root_level`, which is above the leaves: all inner nodes
    /// of that subtree, level by level.
    void build_subtree(uint root_level, uint position) const;

    /// Build all levels above `level`, which stands.
    void build_above(uint level) const;

private:
    void merge_leaves(uint level, uint begin, uint end) const;
    void merge_children(uint level, uint begin, uint end) const;
};

}  // namespace bvhbench
