// SPDX-License-Identifier: MIT
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=0
// check: -include baselines/radix/access_apetrei.clh -DSORTED_LEAVES=0
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DBOX_FORMAT=3u
// check: -include baselines/radix/access_apetrei.clh -DSORTED_LEAVES=1 -DBOX_FORMAT=4u
//
// Finds the roots of several objects' trees if nodes are not numbered by range. Going down from the root of all leaves, an
// object's root is the first node with leaves of that object on both sides of its split. Compiled after an access header.

static inline uint last_leaf_below(TREE_PARAMETERS, uint node)
{
    while (!tree_is_leaf(TREE, node))
        node = tree_right(TREE, node);
    return radix_index(node);
}

kernel void find_roots(FOREST_PARAMETERS, global ForestObject* found, const uint object_count)
{
    const uint k = (uint)get_global_id(0);
    if (k >= object_count)
        return;
    PICK_WHOLE_TREE
    const uint first = found[k].first, last = first + found[k].leaves - 1u;
    uint node = tree_root(TREE);
    while (!tree_is_leaf(TREE, node)) {
        const uint left = tree_left(TREE, node);
        const uint split = last_leaf_below(TREE, left);
        if (first <= split && last > split)
            break;
        node = last <= split ? left : tree_right(TREE, node);
    }
    found[k].root = node;
    (void)objects;
}
