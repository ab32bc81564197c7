// SPDX-License-Identifier: MIT
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=0
//
// Ropes for trees that know only their children: for each node, by its number, the node after its subtree in
// depth-first order. Of several objects, whose trees are parts of one, the last rope of one leads into the next.
//
// The nodes whose subtrees end with a left child's are that child, its right child, that one's, and so on down to
// a leaf; after all of them comes the right sibling. Every node but those on the root's right edge is in one such
// line, so a work-item an inner node writes each rope once, in no particular order.
//
//            p             left child's line: l, m, leaf 2
//          /   \           all of them get the rope to r
//         l     r
//        / \   / \         the root's own line, p, r, leaf 4, leads nowhere
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
        const bool is_root =
            k + 1u == leaves;  // as many inner nodes as leaves, but for one: the root's line
        const uint parent = is_root ? 0u : tree_inner(TREE, k);
        rope_line(TREE, ropes, is_root ? tree_root(TREE) : tree_left(TREE, parent),
                  is_root ? TREE_NONE : tree_right(TREE, parent));
    }
}
