// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "builders/device_tree.h"
#include "oibvh/wide/layout.h"

namespace bvhbench {

/// How many children a wide node has; its layout is in oibvh/wide/floats.clh.
struct WideFormat {
    uint child_bits;  ///< log2 of the children a node
    std::string_view
        text;  ///< header that says so to kernels, and how they walk such a tree (builders/device_tree.h)

    uint children() const { return 1u << child_bits; }
    std::size_t node_words() const { return 6 * std::size_t{children()} / 4; }  ///< of 16 bytes
};

using NodeWord = std::array<uint, 4>;  ///< 16 bytes, the widest access of a lane

/// The wide trees of one or more objects in device memory, one behind the other. Leaf k of the whole line holds
/// triangle ids[k].
class WideTree final : public DeviceTree {
public:
    WideFormat format;
    uint leaves = 0;         ///< of all objects
    uint most_leaves = 0;    ///< of one object
    Buffer<NodeWord> nodes;  ///< inner nodes by slot
    Buffer<uint> ids;

    std::size_t node_count() const override;
    HostTree spelled_out_object(uint object) const override;

    /// Boxes of an object's nodes as their parents keep them: of child k of the inner node in slot s at [s * children + k].
    /// Of children that are not real, anything.
    std::vector<Aabb> stored_boxes(uint object) const;

    uint leaf_count() const override { return leaves; }
    bool has_sorted_leaves() const override { return false; }
    std::string_view access_header() const override { return format.text; }
    bool is_implicit() const override { return true; }
    uint child_bits() const override { return format.child_bits; }
    uint most_levels() const override
    {
        return wide_leaf_level(most_leaves, format.child_bits) + 1;
    }
    cl_uint bind(cl::Kernel& kernel, cl_uint first) const override
    {
        return set_arguments_from(kernel, first, nodes, ids, device_objects);
    }
};

}  // namespace bvhbench
