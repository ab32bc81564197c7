// SPDX-License-Identifier: MIT
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=0
// check: -include baselines/hploc/access.clh -DSORTED_LEAVES=0
//
// Writes ropes (skip links) for trees that store only children: for each node, by its number, the node after its subtree in
// depth-first order. The trees of several objects are parts of one tree, so the last rope of one leads into what follows it.
//
// The subtrees that end where a left child's subtree ends are those of this child, of its right child, of that one's right child
// and so on down to a leaf; the right sibling comes after all of them. Every node that is not on the root's right edge is in
// exactly one such line. So one work-item per inner node writes each rope once, in any order.
//
//            p             the left child's line: l, m, leaf 2
//          /   \           all of them get the rope to r
//         l     r
//        / \   / \         the root's own line, p, r, leaf 4, ends the walk
//       0   m 3   4
//          1 2
#include "builders/stages/chunk.clh"

static inline void rope_line(TREE_PARAMETERS, global uint* ropes, uint node, const uint target)
{
    while (!tree_is_leaf(TREE, node)) {
        ropes[tree_number(TREE, node)] = target;
        node = tree_right(TREE, node);
    }
    ropes[tree_number(TREE, node)] = target;
}

kernel void ropes(FOREST_PARAMETERS, global uint* ropes)
{
    PICK_WHOLE_TREE(void) objects;
    const Chunk chunk = own_chunk(leaves);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const bool is_root = k + 1u == leaves;  // item leaves - 1 handles the root's line
        const uint parent = is_root ? 0u : tree_inner(TREE, k);
        rope_line(TREE, ropes, is_root ? tree_root(TREE) : tree_left(TREE, parent),
                  is_root ? TREE_NONE : tree_right(TREE, parent));
    }
}
