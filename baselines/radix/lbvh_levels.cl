// SPDX-License-Identifier: MIT
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=0
// check: -DCODE_WORDS=2 -DSORTED_LEAVES=1
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=1u
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=3u
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=4u
//
// [Lauterbach2009]: builds the tree level by level from the root down, then boxes from the deepest level up. Each level is one
// launch. Only the device knows the depth, so the host enqueues as many launches as there can be levels; a launch whose level
// is empty ends at once. This is the inherent cost of building by levels, which [Karras2012] avoids.
//
// The paper lists the splits of all levels from pairs of neighbouring codes, sorts the list by level and then removes nodes with
// a single child. Here a node finds its split by binary search and appends its inner children to the next level, as in
// [Garanzha2011]: no second sort, no nodes with a single child, the same tree.
//
//     nodes       level 0 | level 1 | level 2 ...        level l is nodes[begins[l]] to nodes[begins[l + 1] - 1]
//     counts      1       | <= 2    | <= 4    ...        counts[l] grows while level l - 1 is split
//
// The nodes themselves serve as the queue: an unsplit node stores the range of its leaves in the place of its children and,
// between find_split and put_children, its split in the place of its box.
#include "baselines/radix/leaves.clh"

/// Finds the split of node i and stores it in the place of the node's box. Returns how many of its children are inner nodes.
static inline uint find_split(global const Code* codes, global RadixWord* nodes, const uint leaves,
                              const uint i)
{
    const uint first = node_left(nodes, i), last = node_right(nodes, i);
    const uint own = common_of(codes, leaves, first, last);
    uint split = first,
         beyond = last;  // common_of with `first` exceeds own at split, not at beyond
    while (beyond - split > 1u) {
        const uint middle = split + (beyond - split) / 2u;
        if (common_of(codes, leaves, first, middle) > own)
            split = middle;
        else
            beyond = middle;
    }
    store_note(nodes, i, split);
    return (split != first ? 1u : 0u) + (beyond != last ? 1u : 0u);
}

/// Stores the children of node i, whose split was found, and the ranges of those that are inner nodes from `slot` on. Returns
/// the slot after them.
static inline uint put_children(global RadixWord* nodes, const uint i, uint slot)
{
    const uint first = node_left(nodes, i), last = node_right(nodes, i);
    const uint split = node_note(nodes, i);
    uint left = radix_child(split, true), right = radix_child(split + 1u, true);
    if (split != first) {
        store_children(nodes, slot, first, split);
        left = radix_child(slot++, false);
    }
    if (split + 1u != last) {
        store_children(nodes, slot, split + 1u, last);
        right = radix_child(slot++, false);
    }
    store_children(nodes, i, left, right);
    return slot;
}

/// Splits the nodes of `level` and so creates those of the next level. Writes begins[level + 1] and counts[level + 1], which is
/// zero before. One global atomic per group reserves the slots of all children of the group.
kernel void split_level(global const Code* restrict codes, global RadixWord* nodes,
                        global uint* begins, volatile global uint* counts, const uint leaves,
                        const uint level)
{
    local uint group_count, group_slot;
    const uint begin = begins[level], count = counts[level];
    const Chunk chunk = own_chunk(count);
    if (get_global_id(0) == 0) {
        begins[level + 1u] = begin + count;
        if (level == 0u)
            store_children(nodes, 0u, 0u, leaves - 1u);
    }
    if (get_local_id(0) == 0)
        group_count = 0u;
    barrier(CLK_LOCAL_MEM_FENCE);

    uint inner = 0u;
    for (uint k = chunk.first; k < chunk.end; ++k)
        inner += find_split(codes, nodes, leaves, begin + k);
    const uint before = inner != 0u ? atomic_add(&group_count, inner) : 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    if (get_local_id(0) == 0 && group_count != 0u)
        group_slot = begin + count + atomic_add(&counts[level + 1u], group_count);
    barrier(CLK_LOCAL_MEM_FENCE);

    uint slot = inner != 0u ? group_slot + before : 0u;
    for (uint k = chunk.first; k < chunk.end; ++k)
        slot = put_children(nodes, begin + k, slot);
}

/// Computes the boxes of the nodes of `level` from those of their children, which earlier launches computed. Resets
/// counts[level] to zero for the next build, except for level 0.
kernel void box_level(global const BoxWord* restrict leaf_boxes, global const uint* restrict ids,
                      global RadixWord* nodes, global const uint* restrict begins,
                      global uint* counts, const uint level)
{
    const uint begin = begins[level];
    const Chunk chunk = own_chunk(begins[level + 1u] - begin);
    if (get_global_id(0) == 0 && level != 0u)
        counts[level] = 0u;
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const uint i = begin + k;
        const uint left = node_left(nodes, i), right = node_right(nodes, i);
        const Aabb box = merged(child_box(leaf_boxes, ids, nodes, left),
                                child_box(leaf_boxes, ids, nodes, right));
        store_node(nodes, i, box, left, right);
    }
}
