// SPDX-License-Identifier: MIT
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=0
// check: -DCODE_WORDS=2 -DSORTED_LEAVES=1
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=1u
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=3u
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=4u
//
// [Karras2012, Sec. 5]: boxes from the leaves up along parent pointers, the second of two children to arrive
// goes on. It keeps its own box in registers and reads its sibling's.
#include "baselines/radix/nodes.clh"
#include "device/handoff.clh"

static inline void climb_from(global const BoxWord* leaf_boxes, global const uint* ids,
                              global RadixWord* nodes, global const uint* parents,
                              volatile global Arrivals* arrivals, const uint leaves,
                              const uint leaf)
{
    Aabb box = leaf_box(leaf_boxes, ids, leaf);
    uint child = radix_child(leaf, true);
    uint parent = parents[leaves - 1u + leaf];
    for (;;) {
        if (!arrived_second(&arrivals[parent]))
            return;
        forget_arrivals(&arrivals[parent]);
        const uint left = node_left(nodes, parent), right = node_right(nodes, parent);
        box = merged(box, child_box(leaf_boxes, ids, nodes, child == left ? right : left));
        store_node(nodes, parent, box, left, right);
        if (parent == 0u)
            return;
        child = parent;
        parent = parents[child];
    }
}

/// `nodes` has children and gets boxes. `arrivals` is zero, one an inner node, and is zero again afterwards.
kernel void boxes(global const BoxWord* restrict leaf_boxes, global const uint* restrict ids,
                  global RadixWord* nodes, global const uint* restrict parents,
                  volatile global Arrivals* arrivals, const uint leaves)
{
    const Chunk chunk = own_chunk(leaves);
    for (uint leaf = chunk.first; leaf < chunk.end; ++leaf)
        climb_from(leaf_boxes, ids, nodes, parents, arrivals, leaves, leaf);
}
