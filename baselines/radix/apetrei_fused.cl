// SPDX-License-Identifier: MIT
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=0
// check: -DCODE_WORDS=2 -DSORTED_LEAVES=1
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=1u
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=2u
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=4u
//
// [Apetrei2014] in its fastest known form: topology and boxes in one launch, with one atomic exchange per inner node.
//
// As printed, a node's range is stored beside a counter, and boxes are read back. Here the first of two siblings stores the far
// end of its range in the slot of the gap between them; that word also shows that it has arrived. The second takes the word and
// so knows the parent's range. It keeps its own box in registers and reads only its sibling's. Nodes are numbered as in
// [Karras2012], so the ends of a range determine where a sibling is, no ranges are stored, and the root is node 0.
//
//     leaves    first ... split | split+1 ... last      ends[split]: first + 1 from the left child, or
//               left child      | right child                        last + 1 from the right; 0 from neither
//
// Leaf boxes are read in place, as in the implicit builders: copying them to nodes would write 32 bytes per leaf for nothing.
// They are input of the launch, so only boxes of inner nodes are handed over between work-items.
#include "baselines/radix/leaves.clh"
#include "device/handoff.clh"

/// Climbs from `leaf` until a sibling has not arrived yet or the root is built.
static inline void climb_from(global const Code* codes, global const BoxWord* leaf_boxes,
                              global const uint* ids, global RadixWord* nodes,
                              volatile global Arrivals* ends, const uint leaves, const uint leaf)
{
    uint first = leaf, last = leaf;
    uint before = common_of(codes, leaves, first, first - 1u);
    uint after = common_of(codes, leaves, last, last + 1u);
    Aabb box = leaf_box(leaf_boxes, ids, leaf);
    while (before != after) {                 // equal only at the root, where both are 0
        const bool is_left = after > before;  // the parent joins the nearer neighbour
        const uint split = is_left ? last : first - 1u;
        const uint end = exchanged(&ends[split], (is_left ? first : last) + 1u);
        if (end == 0u)
            return;
        forget_arrivals(&ends[split]);

        uint sibling;
        if (is_left) {
            last = end - 1u;
            sibling = radix_child(split + 1u, last == split + 1u);
            after = common_of(codes, leaves, last, last + 1u);
        } else {
            first = end - 1u;
            sibling = radix_child(split, first == split);
            before = common_of(codes, leaves, first, first - 1u);
        }
        box = merged(box, child_box(leaf_boxes, ids, nodes, sibling));
        const uint place = before == after ? 0u : after > before ? last : first;
        store_node(nodes, place, box, radix_child(split, first == split),
                   radix_child(split + 1u, last == split + 1u));
    }
}

/// Builds the radix tree over the ascending `codes` into `nodes`. `ends` has one entry per gap between leaves, zero before and
/// after.
kernel void build(global const Code* restrict codes, global const BoxWord* restrict leaf_boxes,
                  global const uint* restrict ids, global RadixWord* nodes,
                  volatile global Arrivals* ends, const uint leaves)
{
    const Chunk chunk = own_chunk(leaves);
    for (uint leaf = chunk.first; leaf < chunk.end; ++leaf)
        climb_from(codes, leaf_boxes, ids, nodes, ends, leaves, leaf);
}
