// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "builders/stages/kernel_form.h"
#include "builders/stages/medians/medians.h"
#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"
#include "geometry/scene_bounds.h"
#include "geometry/split.h"

namespace bvhbench {

/// A leaf as the kernels in `chunks` move it; a uint4 on the device.
struct Leaf {
    Point centre;
    uint id;
};
static_assert(sizeof(Leaf) == 16);

/// Splits all leaves at exact medians, level by level from the root of an implicit tree, down to aligned blocks of
/// 2^block_height leaves. Within a block the order of ids is unspecified.
///
/// A node's leaves are split across its cell (geometry/split.h). The cell alone determines the axis, so each level is one pass
/// over the leaves. The slab of a leaf decides its side, except in the slab that holds the median: its leaves are appended to a
/// list. A small launch between two passes splits the lists exactly and computes the next level's cuts from the pass's counts
/// per slab. In `chunks`, a work-item splits a subtree node by node, and each split moves the node's leaves.
class CellMedians {
public:
    explicit CellMedians(Programs& programs, MedianShape shape = {});

    /// Takes scratch memory for `size` leaves.
    void plan(Arena& arena, std::size_t size);

    /// Enqueues the splits within the current stage; writes the ids of all leaves to `ids`. Does not block.
    void enqueue(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds, const Buffer<uint>& ids,
                 Queue& queue);

private:
    void in_groups(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds, const Buffer<uint>& ids,
                   Queue& queue);
    void in_chunks(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds, const Buffer<uint>& ids,
                   Queue& queue);
    void enqueue_halve(const Buffer<uint>& ids, uint level, Queue& queue);
    uint nodes_on(uint level) const;
    uint slabs_on(uint level) const;

    MedianShape shape_;
    uint units_;
    uint pass_group_size_ = 0;  ///< Of a pass that counts in global memory.
    std::size_t size_ = 0;
    uint root_height_ = 0;
    uint levels_ = 0;  ///< Number of levels above the blocks.
    NumberAll number_;
    cl::Kernel number_leaves_, clear_, first_pass_, local_pass_, pass_, last_pass_, halve_,
        halve_small_;
    Buffer<Aabb> cells_;  ///< Of the nodes above blocks, level by level.
    Buffer<Leaf> even_,
        odd_;  ///< For `chunks` only: each level of the splits reads one and writes the other.
    // The others are for `groups` only.
    Buffer<CellCut> cuts_;  ///< One per node above blocks.
    Buffer<uint> lefts_;    ///< Per such node: entries of its list that go left.
    Buffer<uint> waiting_;  ///< Per such node: length of its list.
    Buffer<ulong> lists_;  ///< Keys and ids of the lists; a node's list starts where its leaves do.
    Buffer<float> centres_;  ///< All x, then all y, then all z.
    Buffer<uint> nodes_;     ///< Per leaf: the position of its node on the current level.
    Buffer<uint> counts_;    ///< Leaves in each slab of each node of a level.
    Buffer<uint> placed_;    ///< Per block: leaves that have their places.
};

/// Host version of CellMedians, the oracle of the kernels: each block has the same set of leaves.
void host_cell_medians(std::span<const Aabb> boxes, std::span<uint> ids, uint block_height);

}  // namespace bvhbench
