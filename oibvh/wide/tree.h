// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include "builders/device_tree.h"
#include "oibvh/wide/layout.h"

namespace bvhbench {

/// Number of children of a wide node; its layout is in oibvh/wide/floats.clh.
struct WideFormat {
    uint child_bits;  ///< log2 of the children per node.
    std::string_view
        text;  ///< Kernel header that defines the arity and the access functions of builders/device_tree.h.

    uint children() const { return 1u << child_bits; }
    std::size_t node_words() const { return 6 * std::size_t{children()} / 4; }  ///< Of 16 bytes.
};

using NodeWord = std::array<uint, 4>;  ///< 16 bytes, the widest access of a lane.

/// Wide trees of one or more objects in device memory, one after the other. Leaf k, counted over all objects, holds triangle
/// ids[k].
class WideTree final : public DeviceTree {
public:
    WideFormat format;
    uint leaves = 0;         ///< Leaves of all objects.
    uint most_leaves = 0;    ///< Leaves of the largest object.
    Buffer<NodeWord> nodes;  ///< Inner nodes by slot.
    Buffer<uint> ids;

    std::size_t node_count() const override;
    HostTree object_to_host_tree(uint object) const override;

    /// Returns the boxes of an object's nodes as stored in their parents: child k of the inner node in slot s is at [s *
    /// children + k]. Entries of virtual children are undefined.
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
