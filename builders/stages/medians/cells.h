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

/// Halves all leaves at exact medians, level by level from the root of a tree without pointers, down to aligned
/// blocks of 2^block_height leaves. Within a block, ids are left in any order.
///
/// A node's leaves are cut across its cell (geometry/split.h): no box is looked at to choose the axis, so that
/// each level is one pass over the leaves. A pass tells most leaves their side by their slab alone; those in
/// the slab of the median wait in a list for a small launch between two passes, which halves the
/// list exactly, and from the pass's counts of slabs finds the next level's cuts.
class CellMedians {
public:
    explicit CellMedians(Programs& programs, MedianShape shape = {});

    /// Take scratch memory for `size` leaves.
    void plan(Arena& arena, std::size_t size);

    /// Enqueue, as part of the stage begun: `ids` get the leaves. Does not wait.
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
    uint local_leaves_ =
        0;  ///< a work-item looks at, at a time, in a pass that counts in local memory
    uint pass_group_size_ = 0;  ///< of one that counts in global memory
    uint pass_leaves_ = 0;
    uint chunk_levels_ = 0;  ///< halved by fewer work-items than there are cores, level by level
    std::size_t size_ = 0;
    uint root_height_ = 0;
    uint levels_ = 0;  ///< above the blocks
    NumberAll number_;
    cl::Kernel clear_, first_pass_, local_pass_, pass_, last_pass_, halve_, halve_small_;
    Buffer<Aabb> cells_;     ///< of the nodes above blocks, numbered level by level
    Buffer<CellCut> cuts_;   ///< one a node above blocks
    Buffer<uint> lefts_;     ///< of each such node: how many of the leaves that wait go left
    Buffer<uint> waiting_;   ///< of each such node: how many leaves wait
    Buffer<ulong> lists_;    ///< key and id of those that wait, where their nodes' leaves are
    Buffer<float> centres_;  ///< x of all, then y, then z
    Buffer<uint> nodes_;     ///< of each leaf: the position on its level of the node it is in
    Buffer<uint> counts_;    ///< leaves in each slab of each node of a level
    Buffer<uint> placed_;    ///< leaves of each block that have their places
};

/// The same on the host, slowly and obviously: equal to the kernels as sets, block by block.
void host_cell_medians(std::span<const Aabb> boxes, std::span<uint> ids, uint block_height);

}  // namespace bvhbench
