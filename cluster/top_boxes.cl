// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DTOP_BOXES=64u
// check: -include oibvh/wide/wide4_access.clh -DSORTED_LEAVES=0 -DTOP_BOXES=64u
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DTOP_BOXES=64u
//
// Reads the boxes of the nodes of one level of a tree, of any layout: work-item k goes down from the root by the bits of k, the
// highest first. TOP_BOXES is the number of nodes on that level of a full tree.
#include "collide/tree.clh"
#include "geometry/bits.h"
#include "geometry/box_words.clh"

#if TREE_CHILD_BITS > 1u
/// Returns a child of an inner node; TREE_NONE if it has no leaf below it.
static inline uint child_of(TREE_PARAMETERS, const uint node, const uint k)
{
    return (tree_children_from(TREE, node, 0u) >> k & 1u) != 0u ? (node << TREE_CHILD_BITS) + k
                                                                : TREE_NONE;
}
#else
static inline uint child_of(TREE_PARAMETERS, const uint node, const uint k)
{
    return k == 0u ? tree_left(TREE, node) : tree_right(TREE, node);
}
#endif

/// Writes TOP_BOXES boxes, one per work-item; empty ones for nodes that do not exist. A leaf above the level is written once.
kernel void top_boxes(FOREST_PARAMETERS, global BoxWord* tops)
{
    const uint place = (uint)get_global_id(0);
    PICK_TREE(0u)
    uint node = tree_root(TREE), rest = TOP_BOXES;
    while (rest > 1u && node != TREE_NONE && !tree_is_leaf(TREE, node)) {
        rest >>= TREE_CHILD_BITS;
        node = child_of(TREE, node, place / rest & ((1u << TREE_CHILD_BITS) - 1u));
    }
    const bool is_own = node != TREE_NONE && (place & (rest - 1u)) == 0u;
    store_box(tops, place, is_own ? tree_box(TREE, node) : empty_box());
}
