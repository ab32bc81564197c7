// SPDX-License-Identifier: MIT
#pragma once

#include "builders/implicit/layout.h"
#include "builders/ordered_builder.h"

namespace bvhbench {

/// An implicit tree in device memory. Leaf k holds triangle ids[k].
///
///     sorted leaves:   nodes = inner nodes, then leaf boxes in leaf order
///     else (paper):    nodes = inner nodes;  leaf_boxes = one a triangle, in mesh order
class ImplicitTree final : public DeviceTree {
public:
    ImplicitLayout layout;
    uint leaves = 0;
    bool sorted_leaves = false;
    Buffer<Aabb> nodes;       ///< by slot
    Buffer<Aabb> leaf_boxes;  ///< unless sorted
    Buffer<uint> ids;

    std::size_t node_count() const override;
    HostTree spelled_out() const override;
};

}  // namespace bvhbench
