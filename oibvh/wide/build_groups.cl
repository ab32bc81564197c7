// SPDX-License-Identifier: MIT
// check: -include oibvh/wide/wide4.clh -DGROUP_SIZE=64u
// check: -include oibvh/wide/wide8.clh -DGROUP_SIZE=512u
//
// Algorithm 1 over a wide tree, for devices with many lanes: a group builds a subtree from GROUP_SIZE children, a power
// of the children a node, up to its root.
//
//     below the entry level   o o o o o o o o   o o o o o o o o   ...     a child a work-item
//     entry level                    n                 n                  their nodes' boxes, in local memory, are
//     ...                                                                 the next level's children
//
// Compiled behind wide4.clh or wide8.clh.
#include "geometry/forest.h"
#include "oibvh/wide/layout.h"

#define WIDE_KERNEL kernel __attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))

/// A subtree's levels from `level` up: the `position`-th GROUP_SIZE children below it are in `boxes`, of what is not
/// real the empty box.
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
        barrier(CLK_LOCAL_MEM_FENCE);  // all have read
        if (item < width && item % LANE_COUNT == 0u)
            store_local_box(boxes, item / LANE_COUNT, whole);
        barrier(CLK_LOCAL_MEM_FENCE);
    }
}

/// Several launches build the trees of objects. A group's subtree is of the object and at the position that `subtrees`
/// says. The first launch: reads `leaf_boxes`, one a triangle in mesh order, through `ids`, the triangles in leaf order.
WIDE_KERNEL void build_from_leaves(global const float2* leaf_boxes, global const uint* ids,
                                   global uint4* nodes, global const ForestObject* objects,
                                   global const uint2* subtrees)
{
    local float2 boxes[WORDS_PER_BOX * GROUP_SIZE];
    const uint2 subtree = subtrees[get_group_id(0)];
    const ForestObject object = objects[subtree.x];
    const uint item = (uint)get_local_id(0), place = subtree.y * GROUP_SIZE + item;
    store_local_box(
        boxes, item,
        place < object.leaves ? load_box(leaf_boxes, ids[object.first + place]) : empty_box());
    barrier(CLK_LOCAL_MEM_FENCE);
    build_subtree(nodes + NODE_WORDS * object.nodes, boxes, object.leaves, subtree.y,
                  (int)wide_leaf_level(object.leaves, TREE_CHILD_BITS) - 1);
}

/// The others, `levels_done` above the leaves: from the nodes below the entry level.
WIDE_KERNEL void build_from_nodes(global uint4* nodes, global const ForestObject* objects,
                                  global const uint2* subtrees, const uint first_subtree,
                                  const uint levels_done)
{
    local float2 boxes[WORDS_PER_BOX * GROUP_SIZE];
    const uint2 subtree = subtrees[first_subtree + get_group_id(0)];
    const ForestObject object = objects[subtree.x];
    const uint item = (uint)get_local_id(0), position = subtree.y * GROUP_SIZE + item;
    const uint level = wide_leaf_level(object.leaves, TREE_CHILD_BITS) - levels_done;
    global uint4* own = nodes + NODE_WORDS * object.nodes;
    store_local_box(
        boxes, item,
        position < wide_real_on(object.leaves, TREE_CHILD_BITS, level)
            ? node_box(own, wide_first_slot(object.leaves, TREE_CHILD_BITS, level) + position)
            : empty_box());
    barrier(CLK_LOCAL_MEM_FENCE);
    build_subtree(own, boxes, object.leaves, subtree.y, (int)level - 1);
}
