// SPDX-License-Identifier: MIT
// check: -include oibvh/wide/wide4_access.clh -DRUN_BITS=4u -DFAN_BITS=4u
// check: -include oibvh/wide/wide8_access.clh -DRUN_BITS=3u -DFAN_BITS=6u
//
// The wide nodes (wide_node.h) of implicit trees with more than two children a node, by arithmetic: subtrees of 2^RUN_BITS leaves, and
// 2^FAN_BITS children each above them. The children of an object are lists: all subtrees of the first kind, from the left, then the nodes
// above them, level by level. Leaves have their positions in the object's tree.
#include "builders/stages/chunk.clh"
#include "collide/tree.clh"
#include "collide/walks/wide_node.h"

/// Returns the object that child k belongs to: the last one whose children begin at k or before.
static inline uint object_of(global const uint* begins, const uint object_count, const uint k)
{
    uint first = 0u, end = object_count;
    while (end - first > 1u) {
        const uint middle = first + (end - first) / 2u;
        if (begins[middle] <= k)
            first = middle;
        else
            end = middle;
    }
    return first;
}

/// Writes all `count` children, and the ends of their leaves to `child_ends`. Those of an object begin at its entry in `begins`.
kernel void write_children(FOREST_PARAMETERS, const uint object_count, global const uint* begins,
                           const uint count, global WideChild* wide_children,
                           global uint* child_ends)
{
    const Chunk chunk = own_chunk(count);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const uint object = object_of(begins, object_count, k);
        PICK_TREE(object)
        uint list = begins[object], below = 0u, bits = RUN_BITS;
        uint on_level = divided_up(leaves, 1u << RUN_BITS), on_level_below = leaves;
        for (; k - list >= on_level; bits += FAN_BITS) {
            below = list;
            list += on_level;
            on_level_below = on_level;
            on_level = divided_up(on_level, 1u << FAN_BITS);
        }
        const bool is_run = bits == RUN_BITS;
        const uint index = k - list, first = index << (is_run ? RUN_BITS : FAN_BITS);
        const uint count = min(1u << (is_run ? RUN_BITS : FAN_BITS), on_level_below - first);
        const uint level = tree_leaf_level(TREE) - bits / TREE_CHILD_BITS;
        const WideChild child = {tree_box(TREE, first_label(level) + index), below + first,
                                 count | (is_run ? OF_LEAVES : 0u)};
        wide_children[k] = child;
        child_ends[k] = min(leaves, (index + 1u) << bits);
    }
}
