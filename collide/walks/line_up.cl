// SPDX-License-Identifier: MIT
// check: -include baselines/hploc/access.clh -DSORTED_LEAVES=0
// check: -include baselines/hploc/access.clh -DSORTED_LEAVES=1
//
// Finds the positions of leaves and the ranges of inner nodes in the depth-first order of trees whose leaves are not in that order,
// for collapse.cl. Each object's leaves have the positions that its places have.
//
//     link        each node's parent
//     mark_roots  the objects' roots, where climbs end
//     count       how many leaves each inner node's left child and the node itself have: each leaf climbs, and of two that meet the
//                 later one goes on
//     line_up     each leaf's position: it climbs and adds the leaves of left siblings
#include "builders/stages/chunk.clh"
#include "collide/tree.clh"

// A node's entry in `parents` is its parent's number, with this bit if it is a right child; of an object's root, the number of its first
// leaf and this bit, behind those of all inner nodes.
#define IS_RIGHT 0x80000000u
#define NUMBER_OF(entry) ((entry) & ~IS_RIGHT)

/// Writes the parents of all nodes, and makes the ranges of all inner nodes empty.
kernel void link(FOREST_PARAMETERS, global uint* parents, global uint* ends)
{
    PICK_WHOLE_TREE(void) objects;
    const Chunk chunk = own_chunk(leaves - 1u);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const uint node = tree_inner(TREE, k);
        parents[tree_number(TREE, tree_left(TREE, node))] = k;
        parents[tree_number(TREE, tree_right(TREE, node))] = k | IS_RIGHT;
        ends[2ul * k] = ends[2ul * k + 1ul] = 0u;
    }
}

kernel void mark_roots(FOREST_PARAMETERS, const uint object_count, global uint* parents)
{
    const Chunk chunk = own_chunk(object_count);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        PICK_TREE(k)
        parents[tree_number(TREE, tree_root(TREE))] = (all_leaves - 1u + picked.first) | IS_RIGHT;
    }
}

/// Writes to `counts` how many leaves the left child of each inner node has, and how many the node has. `met` is zero before and after.
/// Where two climbs meet, each hands over what it has counted, so nothing else has to be visible.
kernel void count(FOREST_PARAMETERS, global const uint* parents, volatile global uint* met,
                  global uint* counts)
{
    PICK_WHOLE_TREE(void) objects;
    const Chunk chunk = own_chunk(leaves);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        uint own = 1u, entry = parents[tree_number(TREE, tree_leaf(TREE, k))];
        while (NUMBER_OF(entry) < leaves - 1u) {
            const uint node = NUMBER_OF(entry), other = atomic_xchg(met + node, own);
            if (other == 0u)
                break;
            met[node] = 0u;
            counts[2ul * node] = (entry & IS_RIGHT) != 0u ? other : own;
            own += other;
            counts[2ul * node + 1ul] = own;
            entry = parents[node];
        }
    }
}

/// Writes the position of each leaf to `positions`, by place, the place of the leaf at each position to `places`, and the ranges of
/// positions of inner nodes to `ends`: those that begin at a leaf are written by it.
kernel void line_up(FOREST_PARAMETERS, global const uint* parents, global const uint* counts,
                    global uint* positions, global uint* places, global uint* ends)
{
    PICK_WHOLE_TREE(void) objects;
    const Chunk chunk = own_chunk(leaves);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const uint first_entry = parents[tree_number(TREE, tree_leaf(TREE, k))];
        uint entry = first_entry, position = 0u;
        while (NUMBER_OF(entry) < leaves - 1u) {
            if ((entry & IS_RIGHT) != 0u)
                position += counts[2ul * NUMBER_OF(entry)];
            entry = parents[NUMBER_OF(entry)];
        }
        position += NUMBER_OF(entry) - (leaves - 1u);
        positions[k] = position;
        places[position] = k;
        for (entry = first_entry; (entry & IS_RIGHT) == 0u; entry = parents[entry]) {
            ends[2ul * entry] = position;
            ends[2ul * entry + 1ul] = position + counts[2ul * entry + 1ul] - 1u;
        }
    }
}
