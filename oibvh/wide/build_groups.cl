// SPDX-License-Identifier: MIT
// check: -include oibvh/wide/wide4_access.clh -DGROUP_SIZE=64u -DSEVERAL_OBJECTS=1
// check: -include oibvh/wide/wide8_access.clh -DGROUP_SIZE=512u -DFROM_LEAVES=1
//
// Algorithm 1 over a wide tree, for devices with many lanes: a group builds a subtree over GROUP_SIZE children, a power of the
// arity, up to its root.
//
//     below the entry level   o o o o o o o o   o o o o o o o o   ...     one child per work-item
//     entry level                    n                 n                  their nodes' boxes, in local memory, are
//     ...                                                                 the children of the next level
//
// Compiled after wide4_access.clh or wide8_access.clh.
#include "builders/implicit/own_subtree.clh"
#include "oibvh/wide/layout.h"

#define WIDE_KERNEL kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))

/// Builds a subtree's levels from `level` up. `boxes` holds the boxes of the GROUP_SIZE children below it that start at
/// `position` * GROUP_SIZE; virtual children have the empty box.
static inline void build_subtree(global uint4* nodes, local float2* boxes, const uint leaves,
                                 const uint position, int level)
{
    const uint item = (uint)get_local_id(0);
    for (uint width = GROUP_SIZE; width >= LANE_COUNT; width /= LANE_COUNT, --level) {
        const uint node = position * (width / LANE_COUNT) + item / LANE_COUNT;
        Aabb whole = empty_box();
        if (item < width) {
            for (uint k = 0u; k < LANE_COUNT; ++k)
                whole = merged(whole, load_local_box(boxes, item / LANE_COUNT * LANE_COUNT + k));
            if (level >= 0 && node < wide_real_on(leaves, TREE_CHILD_BITS, (uint)level))
                store_child(nodes, wide_first_slot(leaves, TREE_CHILD_BITS, (uint)level) + node,
                            item % LANE_COUNT, load_local_box(boxes, item));
        }
        barrier(CLK_LOCAL_MEM_FENCE);  // all children have been read
        if (item < width && item % LANE_COUNT == 0u)
            store_local_box(boxes, item / LANE_COUNT, whole);
        barrier(CLK_LOCAL_MEM_FENCE);
    }
}

/// One of several launches, which starts `levels_done` levels above the leaves. Reads `leaf_boxes` (one per triangle, in mesh
/// order) through `ids` (triangles in leaf order) with FROM_LEAVES, else the nodes below the entry level.
WIDE_KERNEL void build(global const float2* leaf_boxes, global const uint* ids, global uint4* nodes,
                       global const ForestObject* objects, global const uint2* subtrees,
                       const uint all_leaves, const uint first_subtree, const uint levels_done)
{
    local float2 boxes[WORDS_PER_BOX * GROUP_SIZE];
    const Subtree own =
        own_subtree(objects, subtrees, first_subtree + (uint)get_group_id(0), all_leaves);
    const uint leaves = own.object.leaves;
    const uint item = (uint)get_local_id(0), position = own.position * GROUP_SIZE + item;
    const uint level = wide_leaf_level(leaves, TREE_CHILD_BITS) - levels_done;
    global uint4* tree = nodes + NODE_WORDS * own.object.nodes;
#if FROM_LEAVES
    const Aabb box =
        position < leaves ? load_box(leaf_boxes, ids[own.object.first + position]) : empty_box();
#else
    (void)leaf_boxes, (void)ids;
    const Aabb box =
        position < wide_real_on(leaves, TREE_CHILD_BITS, level)
            ? node_box(tree, wide_first_slot(leaves, TREE_CHILD_BITS, level) + position)
            : empty_box();
#endif
    store_local_box(boxes, item, box);
    barrier(CLK_LOCAL_MEM_FENCE);
    build_subtree(tree, boxes, leaves, own.position, (int)level - 1);
}
