// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=256u -DLEAVES=2u -DLOCAL_SLABS=0u
// check: -DGROUP_SIZE=64u -DLEAVES=4u -DLOCAL_SLABS=4096u
//
// Splits all leaves at exact medians, one level at a time, by their nodes' cells (geometry/split.h). Two kernels alternate, for
// the levels from the root down to that of the blocks:
//
//     pass     sends every leaf to the side of its node's cut that its slab is on, and counts its slab among those
//              of its new node; leaves in the slab of the median are appended to their node's list
//     halve    a group per node: splits its list exactly and counts the slabs of its leaves too; then the counts of
//              its two children determine their cuts
//
// The first pass has no cuts yet; the last one counts nothing and gives every leaf a place in its block. A work-item processes
// LEAVES leaves at a time. Memory is updated in any order; only the set of leaves in each node is deterministic.
#include "builders/stages/medians/cells.clh"
#include "geometry/box_words.clh"

#define TILE (LEAVES * GROUP_SIZE)
#define NOWHERE (~0u)  // node of a leaf in a list

#if LOCAL_SLABS > 0
#define COUNT_ONE(counters, which) atomic_inc(&(counters)[which])
#else
#define COUNT_ONE(counters, which) count_one(counters, which)
#endif

#if LOCAL_SLABS > 0
/// With LOCAL_SLABS, the counts of all slabs of a level fit in local memory: a group counts there and adds its counts to the
/// global ones at the end.
static inline void clear_counts(local uint* const counted, const uint size)
{
    for (uint k = (uint)get_local_id(0); k < size; k += GROUP_SIZE)
        counted[k] = 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
}

static inline void add_counts(local const uint* const counted, volatile global uint* counts,
                              const uint size)
{
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint k = (uint)get_local_id(0); k < size; k += GROUP_SIZE)
        if (counted[k] != 0u)
            atomic_add(&counts[k], counted[k]);
}
#endif

#if LOCAL_SLABS == 0
/// Sets all counters of the passes to zero.
kernel void clear_all(global uint* restrict counts, const uint count_size,
                      global uint* restrict waiting, const uint waiting_size,
                      global uint* restrict placed, const uint placed_size)
{
    for (uint k = (uint)get_global_id(0); k < count_size; k += (uint)get_global_size(0))
        counts[k] = 0u;
    for (uint k = (uint)get_global_id(0); k < waiting_size; k += (uint)get_global_size(0))
        waiting[k] = 0u;
    for (uint k = (uint)get_global_id(0); k < placed_size; k += (uint)get_global_size(0))
        placed[k] = 0u;
}
#endif

#if LOCAL_SLABS > 0
/// First pass: writes the centres by axis, the root's cut and the counts of the root's slabs.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void first_pass(
    global const float2* restrict boxes, global const Bounds* restrict bounds,
    global float* restrict centres, global Aabb* restrict cells, global CellCut* restrict cuts,
    volatile global uint* counts, const uint count, const uint root_height)
{
    local uint counted[LOCAL_SLABS];
    const uint slabs = slab_count(0u, root_height);
    const Aabb cell = bounds->centres;
    const CellCut cut = cut_of_cell(cell, slabs);
    clear_counts(counted, slabs);
    for (uint first = (uint)get_group_id(0) * TILE; first < count;
         first += (uint)get_num_groups(0) * TILE) {
        Point centre[LEAVES];
        for (uint i = 0u; i < LEAVES; ++i) {
            const uint k = min(first + i * GROUP_SIZE + (uint)get_local_id(0), count - 1u);
            centre[i] = box_centre(load_box(boxes, k));
        }
        for (uint i = 0u; i < LEAVES; ++i) {
            const uint k = first + i * GROUP_SIZE + (uint)get_local_id(0);
            if (k < count) {
                centres[k] = centre[i].x;
                centres[(ulong)count + k] = centre[i].y;
                centres[2ul * count + k] = centre[i].z;
                atomic_inc(&counted[slab_of(cut, coordinate(centre[i], cut.axis), slabs)]);
            }
        }
    }
    add_counts(counted, counts, slabs);
    if (get_global_id(0) == 0) {
        cells[0] = cell;
        cuts[0] = cut;
    }
}
#endif

/// Pass down to `level`, above the level of the blocks.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void pass(
    global const float* restrict centres, global uint* restrict nodes,
    global const CellCut* restrict cuts, volatile global uint* counts,
    volatile global uint* waiting, global ulong* restrict lists, const uint count,
    const uint root_height, const uint level)
{
    const uint slabs_above = slab_count(level - 1u, root_height - level + 1u);
    const uint slabs = slab_count(level, root_height - level);
#if LOCAL_SLABS > 0
    local uint counted[LOCAL_SLABS];
    clear_counts(counted, slabs << level);
#else
    volatile global uint* const counted = counts;
#endif
    // Each step is done for all LEAVES leaves before the next, so that their loads overlap.
    for (uint first = (uint)get_group_id(0) * TILE; first < count;
         first += (uint)get_num_groups(0) * TILE) {
        uint node[LEAVES];
        CellCut cut[LEAVES];
        float at[LEAVES];
        for (uint i = 0u; i < LEAVES; ++i) {
            // Not clamped to the last leaf, whose node may have been overwritten by then.
            const uint k = first + i * GROUP_SIZE + (uint)get_local_id(0);
            node[i] = level > 1u && k < count ? nodes[k] : 0u;
        }
        for (uint i = 0u; i < LEAVES; ++i)
            cut[i] = cuts[first_node(level - 1u) + node[i]];
        for (uint i = 0u; i < LEAVES; ++i) {
            const uint k = min(first + i * GROUP_SIZE + (uint)get_local_id(0), count - 1u);
            at[i] = centres[(ulong)cut[i].axis * count + k];
        }
        for (uint i = 0u; i < LEAVES; ++i) {
            const uint k = first + i * GROUP_SIZE + (uint)get_local_id(0);
            const uint slab = slab_of(cut[i], at[i], slabs_above);
            const bool waits = slab == cut[i].slab;
            if (waits && k < count)
                append_waiting(waiting, lists, node[i], root_height - level + 1u, level - 1u, at[i],
                               k);
            node[i] = waits ? NOWHERE : 2u * node[i] + (slab > cut[i].slab ? 1u : 0u);
            if (!waits && k < count)
                nodes[k] = node[i];
            cut[i] = cuts[first_node(level) + (waits ? 0u : node[i])];
        }
        for (uint i = 0u; i < LEAVES; ++i) {
            const uint k = min(first + i * GROUP_SIZE + (uint)get_local_id(0), count - 1u);
            at[i] = centres[(ulong)cut[i].axis * count + k];
        }
        for (uint i = 0u; i < LEAVES; ++i) {
            const uint k = first + i * GROUP_SIZE + (uint)get_local_id(0);
            if (node[i] != NOWHERE && k < count)
                COUNT_ONE(counted, node[i] * slabs + slab_of(cut[i], at[i], slabs));
        }
    }
#if LOCAL_SLABS > 0
    add_counts(counted, counts, slabs << level);
#endif
}

#if LOCAL_SLABS == 0
/// Pass down to the blocks: gives every leaf a place in its block, except leaves in lists.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void last_pass(
    global const float* restrict centres, global const uint* restrict nodes,
    global const CellCut* restrict cuts, volatile global uint* placed,
    volatile global uint* waiting, global ulong* restrict lists, global uint* restrict ids,
    const uint count, const uint root_height, const uint level)
{
    const uint slabs_above = slab_count(level - 1u, root_height - level + 1u);
    for (uint k = (uint)get_global_id(0); k < count; k += (uint)get_global_size(0)) {
        const uint node = level > 1u ? nodes[k] : 0u;
        const CellCut cut = cuts[first_node(level - 1u) + node];
        const float at = centres[(ulong)cut.axis * count + k];
        const uint slab = slab_of(cut, at, slabs_above);
        if (slab == cut.slab)
            append_waiting(waiting, lists, node, root_height - level + 1u, level - 1u, at, k);
        else
            place_leaf(placed, ids, 2u * node + (slab > cut.slab ? 1u : 0u), root_height - level,
                       k);
    }
}
#endif
