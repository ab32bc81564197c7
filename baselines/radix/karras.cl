// SPDX-License-Identifier: MIT
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=0
// check: -DCODE_WORDS=2 -DSORTED_LEAVES=1
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=1u
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=3u
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=4u
//
// [Karras2012]. Section 4: builds all inner nodes in parallel from the codes. The paper's names: delta is common_of, delta_min
// is `farthest_other`, l is `reach`, s is `to_split`, gamma is `split`. Section 5: computes boxes from the leaves up along
// parent pointers. The second of two children to arrive continues; it keeps its own box in registers and reads its sibling's.
#include "baselines/radix/leaves.clh"
#include "device/handoff.clh"

/// Builds inner node i, which covers leaf i and, on the side of its nearer neighbour, all leaves that have more in common with
/// leaf i than its other neighbour has.
static inline void make_node(global const Code* codes, global RadixWord* nodes,
                             global uint* parents, const uint leaves, const uint i)
{
    const uint before = common_of(codes, leaves, i, i - 1u);
    const uint after = common_of(codes, leaves, i, i + 1u);
    const uint step = after > before ? 1u : ~0u;  // ~0 is a step to the left
    const uint farthest_other = min(before, after);

    uint bound = 2u;
    while (common_of(codes, leaves, i, i + bound * step) > farthest_other)
        bound *= 2u;
    const uint reach = farthest_with(codes, leaves, i, step, bound, farthest_other);
    const uint j = i + reach * step;

    // The child that contains leaf i: all leaves that have more in common with leaf i than leaf j has.
    const uint own = common_of(codes, leaves, i, j);
    const uint to_split = farthest_with(codes, leaves, i, step, bound, own);
    const uint first = min(i, j), last = max(i, j);
    const uint split = step == 1u ? i + to_split : i - to_split - 1u;

    const uint left = radix_child(split, first == split);
    const uint right = radix_child(split + 1u, last == split + 1u);
    store_node(nodes, i, empty_box(), left, right);
    parents[radix_is_leaf(left) ? leaves - 1u + split : split] = i;
    parents[radix_is_leaf(right) ? leaves + split : split + 1u] = i;
    if (i == 0u)
        parents[0] = NO_PARENT;
}

/// Writes the children of every inner node, with empty boxes, and to `parents` the parent of every node: inner nodes first, then
/// leaves.
kernel void topology(global const Code* restrict codes, global RadixWord* restrict nodes,
                     global uint* restrict parents, const uint leaves)
{
    const Chunk chunk = own_chunk(leaves - 1u);
    for (uint i = chunk.first; i < chunk.end; ++i)
        make_node(codes, nodes, parents, leaves, i);
}

/// Climbs from `leaf` until a sibling has not arrived yet or the root has its box.
static inline void climb_from(global const BoxWord* leaf_boxes, global const uint* ids,
                              global RadixWord* nodes, global const uint* parents,
                              volatile global Arrivals* arrivals, const uint leaves,
                              const uint leaf)
{
    Aabb box = leaf_box(leaf_boxes, ids, leaf);
    uint child = radix_child(leaf, true);
    uint parent = parents[leaves - 1u + leaf];
    while (parent != NO_PARENT) {
        if (!arrived_second(&arrivals[parent]))
            return;
        forget_arrivals(&arrivals[parent]);
        const uint left = node_left(nodes, parent), right = node_right(nodes, parent);
        box = merged(box, child_box(leaf_boxes, ids, nodes, child == left ? right : left));
        store_node(nodes, parent, box, left, right);
        child = parent;
        parent = parents[child];
    }
}

/// Writes the boxes of `nodes`, whose children are given. `arrivals` has one entry per inner node, zero before and after.
kernel void boxes(global const BoxWord* restrict leaf_boxes, global const uint* restrict ids,
                  global RadixWord* nodes, global const uint* restrict parents,
                  volatile global Arrivals* arrivals, const uint leaves)
{
    const Chunk chunk = own_chunk(leaves);
    for (uint leaf = chunk.first; leaf < chunk.end; ++leaf)
        climb_from(leaf_boxes, ids, nodes, parents, arrivals, leaves, leaf);
}
