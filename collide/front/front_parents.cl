// SPDX-License-Identifier: MIT
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=0
//
// For trees that store only children: computes each node's parent and its depth below its object's root, by node number. Takes
// three launches after each build; a refit leaves the result valid.
#include "builders/stages/chunk.clh"

kernel void list_parents(FOREST_PARAMETERS, global uint2* parents)
{
    PICK_WHOLE_TREE
    const Chunk chunk = own_chunk(leaves);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        if (k + 1u == leaves) {  // the last item has no inner node
            parents[tree_number(TREE, tree_root(TREE))] = (uint2)(TREE_NONE, 0u);
            continue;
        }
        const uint parent = tree_inner(TREE, k);
        parents[tree_number(TREE, tree_left(TREE, parent))].x = parent;
        parents[tree_number(TREE, tree_right(TREE, parent))].x = parent;
    }
    (void)objects;
}

/// Cuts the trees of the objects, which are parts of one tree, apart, so that no entry climbs out of its object's tree.
kernel void cut_off_roots(FOREST_PARAMETERS, global uint2* parents, const uint object_count)
{
    const uint object = (uint)get_global_id(0);
    if (object >= object_count)
        return;
    PICK_TREE(object)
    parents[tree_number(TREE, tree_root(TREE))].x = TREE_NONE;
}

kernel void list_depths(FOREST_PARAMETERS, global uint2* parents)
{
    PICK_WHOLE_TREE
    const Chunk chunk = own_chunk(2u * leaves - 1u);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        uint depth = 0u;
        for (uint node = parents[k].x; node != TREE_NONE; node = parents[tree_number(TREE, node)].x)
            ++depth;
        parents[k].y = depth;
    }
    (void)objects;
}
