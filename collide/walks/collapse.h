// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "builders/device_tree.h"
#include "collide/walks/wide_node.h"
#include "device/arena.h"
#include "device/program.h"

namespace bvhbench {

/// Collapses a tree into the wide nodes that `block` walks: a binary one with pointers (collapse.cl), or an implicit one with 4 or 8
/// children a node (collapse_implicit.cl).
class Collapse {
public:
    /// Compiles for this tree. `room` is the first capacity in children, or 0.
    Collapse(Programs& programs, const DeviceTree& tree, std::size_t room);

    /// Takes all memory: 36 bytes a child, and but for implicit trees some 6 a leaf, 32 more if leaves are not in the tree's order.
    void plan(Arena& arena);

    /// Clears what enqueue() expects clear in new memory. Waits.
    void prepare(const cl::CommandQueue& queue);

    /// Enqueues the stage. Does not block.
    void enqueue(const DeviceTree& tree, Queue& queue);

    /// True if there was room for `children`; otherwise the next plan() takes more.
    bool had_room_for(std::uint64_t children);

    /// Number of classes of wide nodes: CLASSES of block_team.clh.
    uint classes() const { return std::max(1u, lists_); }

    /// What block_collapsed.clh takes.
    const Buffer<std::byte>& children() const { return children_; }
    const Buffer<uint>& child_ends() const { return child_ends_; }
    const Buffer<cl_uint2>& roots() const { return roots_; }
    const Buffer<uint>& child_count() const { return child_count_; }
    const Buffer<uint>& places() const { return places_; }
    uint room() const { return static_cast<uint>(room_); }

private:
    /// Finds where the lists of children of an implicit tree begin and end.
    void list_children(const DeviceTree& tree);

    const Device& device_;
    bool is_implicit_, is_in_order_, is_numbered_by_range_;
    uint leaves_, objects_, lists_, words_;
    std::size_t child_bytes_, room_;
    std::vector<uint> begin_list_;  ///< of an implicit tree, as `begins_`
    std::vector<cl_uint2> root_list_;
    Buffer<uint> begins_;
    cl::Kernel write_, mark_, count_, fill_;
    std::vector<cl::Kernel> line_up_;  ///< if leaves are not in the tree's order
    uint epoch_ = 0;                   ///< of the last look-back
    Buffer<cl_uint2> roots_;
    Buffer<uint> positions_, places_, parents_, met_, leaf_counts_;  ///< line_up.cl
    Buffer<cl_uint2> counts_;
    Buffer<uint> ends_, marks_, child_ends_, child_count_, tiles_taken_;
    Buffer<std::uint64_t> states_;
    Buffer<std::byte> children_;
};

}  // namespace bvhbench
