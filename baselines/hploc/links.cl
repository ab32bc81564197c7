// SPDX-License-Identifier: MIT
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=0
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=1u
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=3u
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=1 -DBOX_FORMAT=4u
//
// What the kernel `boxes` of karras.cl needs to compute the boxes of a tree whose children are known: the parent of each node.
#include "baselines/radix/leaves.clh"

/// Writes the parents of the children of node k. Work-item 0 writes that the root has none.
static inline void link(global uint* parents, const uint leaves, const uint root, const uint k,
                        const uint left, const uint right)
{
    parents[radix_index(left) + (radix_is_leaf(left) ? leaves - 1u : 0u)] = k;
    parents[radix_index(right) + (radix_is_leaf(right) ? leaves - 1u : 0u)] = k;
    if (k == 0u)
        parents[root] = NO_PARENT;
}

/// Lists the parents of all nodes, inner nodes first.
kernel void link_nodes(global const RadixWord* restrict nodes, global const uint* restrict root,
                       global uint* restrict parents, const uint leaves)
{
    const Chunk chunk = own_chunk(leaves - 1u);
    for (uint k = chunk.first; k < chunk.end; ++k)
        link(parents, leaves, *root, k, node_left(nodes, k), node_right(nodes, k));
}

/// The same, and copies the children from nodes with boxes of floats, `built`, to `nodes`.
kernel void copy_links(global const uint4* restrict built, global RadixWord* restrict nodes,
                       global const uint* restrict root, global uint* restrict parents,
                       const uint leaves)
{
    const Chunk chunk = own_chunk(leaves - 1u);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const uint left = built[2ul * k].w, right = built[2ul * k + 1ul].w;
        store_children(nodes, k, left, right);
        link(parents, leaves, *root, k, left, right);
    }
}
