// SPDX-License-Identifier: MIT
#pragma once

#include "builders/device_tree.h"
#include "builders/implicit/layout.h"

namespace bvhbench {

/// The implicit trees of one or more objects in device memory, one behind the other. Leaf k of the whole line
/// holds triangle ids[k].
///
///     sorted leaves:   nodes = of each object, inner nodes and then leaf boxes in leaf order
///     else (paper):    nodes = of each object, inner nodes;  leaf_boxes = one a triangle, in mesh order
class ImplicitTree final : public DeviceTree {
public:
    ImplicitLayout layout;
    uint leaves = 0;       ///< of all objects
    uint most_leaves = 0;  ///< of one object
    bool sorted_leaves = false;
    const BoxFormat* format = &float_boxes();
    std::size_t slot_count = 0;  ///< of all objects
    Buffer<std::byte> nodes;     ///< by slot, a box of the format each
    Buffer<SceneCells> cells;    ///< one, of formats with cells
    Buffer<Aabb> leaf_boxes;     ///< unless sorted
    Buffer<uint> ids;

    std::size_t node_count() const override;
    HostTree spelled_out_object(uint object) const override;

    /// How leaves were rounded last. Waits.
    BoxRounding rounding() const;

    /// Slots of a tree of so many leaves: inner nodes, and with sorted leaves all that are stored.
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
