// SPDX-License-Identifier: MIT
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=0
// check: -DCODE_WORDS=2 -DSORTED_LEAVES=1
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=1u
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=3u
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=4u
//
// All levels in one launch (levels.clh), for groups that are all resident at the same time. They wait for each other after each
// level instead of ending (device/handoff.clh), so that there are as many steps as levels, however many there could be.
//
// Nodes change within the launch, so `nodes` is not restrict; a restrict buffer may be read through a cache that is not coherent.
#include "baselines/radix/levels.clh"
#include "device/handoff.clh"

/// Waits for all groups. `step` numbers the waits of a launch; all earlier waits had numbers below `epoch` + `step`.
static inline void end_step(volatile global ulong* waits, const ulong epoch, const uint step)
{
    wait_for_all(waits, (uint)get_group_id(0), (uint)get_num_groups(0), epoch + step);
}

/// Computes the boxes of all nodes, in `levels` levels. Before it, `steps` waits have been made.
static inline void box_levels(global const BoxWord* leaf_boxes, global const uint* ids,
                              global RadixWord* nodes, volatile global const uint* begins,
                              volatile global ulong* waits, const uint leaves, const uint levels,
                              const ulong epoch, uint steps)
{
    uint end = leaves - 1u;
    for (uint level = levels; level-- > 0u;) {
        const uint begin = begins[level];
        box_nodes(leaf_boxes, ids, nodes, begin, end);
        end = begin;
        if (level != 0u)
            end_step(waits, epoch, steps++);
    }
}

/// Builds the tree. Writes begins[l] of all levels and the end of the last, which is `leaves` - 1. counts[0] is 1 and all others
/// are 0, before and after. `waits` has a word per group.
kernel void build_at_once(global const Code* restrict codes,
                          global const BoxWord* restrict leaf_boxes,
                          global const uint* restrict ids, global RadixWord* nodes,
                          volatile global uint* begins, volatile global uint* counts,
                          volatile global ulong* waits, const uint leaves, const ulong epoch)
{
    local Reserved reserved;
    const bool is_first = get_global_id(0) == 0;
    if (is_first)
        store_children(nodes, 0u, 0u, leaves - 1u);
    uint level = 0u, begin = 0u;
    for (uint count = 1u; count != 0u; count = counts[level]) {
        split_nodes(codes, nodes, &counts[level + 1u], &reserved, leaves, begin, count);
        end_step(waits, epoch, level++);
        begin += count;
        if (is_first)
            begins[level] = begin;
    }
    box_levels(leaf_boxes, ids, nodes, begins, waits, leaves, level, epoch, level);
    if (is_first)
        for (uint k = 1u; k < level; ++k)
            counts[k] = 0u;
}

/// Computes the boxes of all nodes over the topology of the last build.
kernel void boxes_at_once(global const BoxWord* restrict leaf_boxes,
                          global const uint* restrict ids, global RadixWord* nodes,
                          volatile global const uint* begins, volatile global ulong* waits,
                          const uint leaves, const ulong epoch)
{
    uint levels = 0u;
    while (begins[levels] != leaves - 1u)
        ++levels;
    box_levels(leaf_boxes, ids, nodes, begins, waits, leaves, levels, epoch, 0u);
}
