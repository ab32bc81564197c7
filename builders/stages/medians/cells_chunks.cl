// SPDX-License-Identifier: MIT
//
// Splits nodes by their cells, one subtree per work-item: the form of cells_groups.cl for devices with a few fast cores. Nodes are
// split in preorder, so that the leaves of a small subtree stay in a cache.
#include "builders/stages/medians/cells.clh"
#include "builders/stages/medians/halve.clh"

#define MOST_SLABS 4096u

/// Splits the `count` leaves of a node, from `first` on, across its cell, and stores its children's cells.
static inline void halve_by_cell(global const uint4* from, global uint4* to, global Aabb* cells,
                                 const uint first, const uint count, const uint level,
                                 const uint height, local uint* const slab_counts)
{
    const uint node = first_node(level) + (first >> height);
    const uint child = first_node(level + 1u) + 2u * (first >> height);
    const uint left = left_count(count, height);
    const Aabb cell = cells[node];
    if (left == count) {
        copy_leaves(from + first, to + first, count);
        cells[child] = cell;
        return;
    }
    const uint slabs = slab_count(level, height);
    CellCut cut = cut_of_cell(cell, slabs);
    cut.slab = halve(from + first, to + first, cut, slabs, count, left, slab_counts);
    cells[child] = left_cell(cell, cut, slabs);
    cells[child + 1u] = right_cell(cell, cut, slabs);
}

/// Writes all leaves, by id.
kernel void number_leaves(global const float2* restrict boxes, global uint4* restrict leaves,
                          const uint count)
{
    const uint k = (uint)get_global_id(0);
    if (k < count)
        leaves[k] = leaf_of(box_centre(load_box(boxes, k)), k);
}

/// Splits the nodes on `level`, one per work-item, then their children, and so on down to nodes at height `bottom`. The leaves of
/// `level` are in `from`; each level writes the other buffer. With `writes_ids`, those of the last level are written to `ids`. The
/// cells of `level` must be known (level 0 sets the root's).
kernel void halve_nodes(global const Bounds* restrict bounds, global uint4* from, global uint4* to,
                        global Aabb* restrict cells, global uint* restrict ids, const uint count,
                        const uint root_height, const uint level, const uint bottom,
                        const uint writes_ids)
{
    local uint slab_counts[MOST_SLABS];
    const uint top = root_height - level;
    const uint start = (uint)get_global_id(0) << top;
    const uint here = min(1u << top, count - start);
    if (level == 0u)
        cells[0] = bounds->centres;
    // In preorder: a lowest node comes after those above it that begin where it does.
    for (uint first = 0u; first < here; first += 1u << bottom) {
        const uint highest = first == 0u ? top : lowest_bit(first);
        for (uint height = highest; height >= bottom; --height) {
            const bool is_even = (top - height) % 2u == 0u;
            halve_by_cell(is_even ? from : to, is_even ? to : from, cells, start + first,
                          min(1u << height, here - first), root_height - height, height,
                          slab_counts);
        }
        if (writes_ids != 0u) {
            global const uint4* const last = (top - bottom) % 2u == 0u ? to : from;
            const uint end = start + min(first + (1u << bottom), here);
            for (uint k = start + first; k < end; ++k)
                ids[k] = last[k].w;
        }
    }
}
