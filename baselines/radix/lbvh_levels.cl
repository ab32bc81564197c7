// SPDX-License-Identifier: MIT
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=0
// check: -DCODE_WORDS=2 -DSORTED_LEAVES=1
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=1u
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=3u
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=4u
//
// A launch a level (levels.clh). Only the device knows the depth, so the host enqueues as many launches as there can be levels; a
// launch whose level is empty ends at once. Where groups may wait for each other, levels_at_once.cl needs no such launches.
#include "baselines/radix/levels.clh"

/// Splits the nodes of `level` and so creates those of the next level. Writes begins[level + 1] and counts[level + 1], which is
/// zero before.
kernel void split_level(global const Code* restrict codes, global RadixWord* nodes,
                        global uint* begins, volatile global uint* counts, const uint leaves,
                        const uint level)
{
    local Reserved reserved;
    const uint begin = begins[level], count = counts[level];
    if (get_global_id(0) == 0) {
        begins[level + 1u] = begin + count;
        if (level == 0u)
            store_children(nodes, 0u, 0u, leaves - 1u);
    }
    split_nodes(codes, nodes, &counts[level + 1u], &reserved, leaves, begin, count);
}

/// Computes the boxes of the nodes of `level` from those of their children, which earlier launches computed. Resets
/// counts[level] to zero for the next build, except for level 0.
kernel void box_level(global const BoxWord* restrict leaf_boxes, global const uint* restrict ids,
                      global RadixWord* nodes, global const uint* restrict begins,
                      global uint* counts, const uint level)
{
    if (get_global_id(0) == 0 && level != 0u)
        counts[level] = 0u;
    box_nodes(leaf_boxes, ids, nodes, begins[level], begins[level + 1u]);
}
