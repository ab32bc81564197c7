// SPDX-License-Identifier: MIT
#pragma once

#include "builders/device_tree.h"
#include "builders/implicit/layout.h"

namespace bvhbench {

/// Implicit trees of one or more objects in device memory, one after the other. Leaf k, counted over all objects, holds
/// triangle ids[k].
///
///     sorted leaves:     nodes = per object, inner nodes, then leaf boxes in leaf order
///     otherwise (paper): nodes = per object, inner nodes;  leaf_boxes = one per triangle, in mesh order
class ImplicitTree final : public DeviceTree {
public:
    ImplicitLayout layout;
    uint leaves = 0;       ///< Leaves of all objects.
    uint most_leaves = 0;  ///< Leaves of the largest object.
    bool sorted_leaves = false;
    const BoxFormat* format = &float_boxes();
    std::size_t slot_count = 0;  ///< Slots of all objects.
    Buffer<std::byte> nodes;     ///< By slot, one box in `format` each.
    Buffer<SceneCells> cells;    ///< One element, used by formats with cells.
    Buffer<Aabb> leaf_boxes;     ///< Unless leaves are sorted.
    Buffer<uint> ids;

    std::size_t node_count() const override;
    HostTree object_to_host_tree(uint object) const override;

    /// Returns how the leaf boxes were last rounded. Blocks.
    BoxRounding rounding() const;

    /// Returns the slots of a tree of `leaf_count` leaves: inner nodes, and with sorted leaves all nodes stored.
    std::size_t slots(uint leaf_count) const;

    uint leaf_count() const override { return leaves; }
    const BoxFormat& box_format() const override { return *format; }
    bool has_sorted_leaves() const override { return sorted_leaves; }
    std::string_view access_header() const override { return layout.access; }
    bool is_implicit() const override { return true; }
    uint most_levels() const override { return implicit_leaf_level(most_leaves) + 1; }
    cl_uint bind(cl::Kernel& kernel, cl_uint first) const override
    {
        return set_arguments_from(kernel, first, nodes, leaf_boxes, ids, device_objects);
    }
};

}  // namespace bvhbench
