// SPDX-License-Identifier: MIT
// check: -include oibvh/wide/wide4_access.clh -DSEVERAL_OBJECTS=1
// check: -include oibvh/wide/wide8_access.clh -DFROM_LEAVES=1
//
// Algorithm 1 over a wide tree, for devices with a few fast cores: a work-item builds a whole subtree, level by level.
// Same launches and arguments as build_groups.cl, with the number of `levels` per launch chosen at run time.
//
// Compiled after wide4_access.clh or wide8_access.clh.
#include "builders/implicit/own_subtree.clh"
#include "oibvh/wide/layout.h"

/// Stores a node with these children.
static inline void store_node(global uint4* nodes, const uint slot, const Aabb* children)
{
    for (uint k = 0u; k < LANE_COUNT; ++k)
        store_child(nodes, slot, k, children[k]);
}

/// Builds the nodes of `level` at positions `begin` to `end` - 1 from the level below.
static inline void build_level(global uint4* nodes, const uint leaves, const uint level,
                               const uint begin, const uint end)
{
    const uint slot = wide_first_slot(leaves, TREE_CHILD_BITS, level);
    const uint below = wide_first_slot(leaves, TREE_CHILD_BITS, level + 1u);
    const uint count = wide_real_on(leaves, TREE_CHILD_BITS, level + 1u);
    Aabb children[LANE_COUNT];
    for (uint node = begin; node < end; ++node) {
        for (uint k = 0u; k < LANE_COUNT; ++k) {
            const uint child = LANE_COUNT * node + k;
            children[k] = child < count ? node_box(nodes, below + child) : empty_box();
        }
        store_node(nodes, slot + node, children);
    }
}

/// Builds the levels above `level` of the subtree whose root is at `position`, `above` levels higher.
static inline void build_upwards(global uint4* nodes, const uint leaves, const uint position,
                                 uint level, uint above)
{
    while (above > 0u) {
        --level;
        --above;
        const uint real = wide_real_on(leaves, TREE_CHILD_BITS, level);
        build_level(nodes, leaves, level, min(position << (TREE_CHILD_BITS * above), real),
                    min((position + 1u) << (TREE_CHILD_BITS * above), real));
    }
}

kernel void build(global const float2* leaf_boxes, global const uint* ids, global uint4* nodes,
                  global const ForestObject* objects, global const uint2* subtrees,
                  const uint all_leaves, const uint first_subtree, const uint levels_done,
                  const uint levels)
{
    const Subtree own =
        own_subtree(objects, subtrees, first_subtree + (uint)get_global_id(0), all_leaves);
    const uint leaves = own.object.leaves;
    uint level = wide_leaf_level(leaves, TREE_CHILD_BITS) - levels_done;
    uint above = min(levels, level);
    global uint4* tree = nodes + NODE_WORDS * own.object.nodes;
#if FROM_LEAVES
    --level;
    --above;
    const uint real = wide_real_on(leaves, TREE_CHILD_BITS, level);
    const uint slot = wide_first_slot(leaves, TREE_CHILD_BITS, level);
    const uint end = min((own.position + 1u) << (TREE_CHILD_BITS * above), real);
    Aabb children[LANE_COUNT];
    for (uint node = own.position << (TREE_CHILD_BITS * above); node < end; ++node) {
        for (uint k = 0u; k < LANE_COUNT; ++k) {
            const uint place = LANE_COUNT * node + k;
            children[k] =
                place < leaves ? load_box(leaf_boxes, ids[own.object.first + place]) : empty_box();
        }
        store_node(tree, slot + node, children);
    }
#else
    (void)leaf_boxes, (void)ids;
#endif
    build_upwards(tree, leaves, own.position, level, above);
}
