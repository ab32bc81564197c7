// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DSINK_BLOCK=512u
// check: -include oibvh/wide/wide8_q8_access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=1 -DSINK_BLOCK=512u
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DSINK_BLOCK=512u
//
// Eight neighbouring leaves as one query, for few cores with wide registers: they walk the tree together, without a
// stack, over what lies behind them. A node that their common box meets is tested against all eight at once, and goes
// on being walked if one of them meets it. A wide tree's inner nodes are tested against the common box only, eight of
// them at once.
#include "builders/stages/chunk.clh"
#include "collide/sink_chunks.clh"
#include "collide/task.clh"
#if TREE_CHILD_BITS > 1u
#include "collide/wide_walk.clh"
#endif

#define LANES 8u

static inline float least(const float8 v)
{
    const float4 of_two = fmin(v.lo, v.hi);
    const float2 of_four = fmin(of_two.lo, of_two.hi);
    return fmin(of_four.x, of_four.y);
}

/// A bit a lane whose box overlaps `box`.
static inline uint lanes_that_meet(const float8 min_x, const float8 min_y, const float8 min_z,
                                   const float8 max_x, const float8 max_y, const float8 max_z,
                                   const Aabb box)
{
    const int8 meets = (min_x <= box.max_x) & (max_x >= box.min_x) & (min_y <= box.max_y) &
                       (max_y >= box.min_y) & (min_z <= box.max_z) & (max_z >= box.min_z);
    const int8 bits = meets & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
    const int4 of_two = bits.lo | bits.hi;
    const int2 of_four = of_two.lo | of_two.hi;
    return (uint)(of_four.x | of_four.y);
}

/// Pairs of triangle `other` with those of the lanes of `meeting`.
static inline void put_lanes(global const Face* faces, SINK_PARAMETERS, const uint* own_triangles,
                             uint meeting, const uint other)
{
    for (; meeting != 0u; meeting &= meeting - 1u) {
        const uint own = own_triangles[31u - clz(meeting & (0u - meeting))];
        if (is_wanted(faces, own, other))
            put(SINK_PASSED, pair_of(own, other));
    }
}

/// The query of leaves `first` to before `end` of a task, LANES at most. How many boxes it tested.
static inline uint walk_with(FOREST_PARAMETERS, global const uint* ropes, global const Face* faces,
                             SINK_PARAMETERS, const QueryTask task, const uint first,
                             const uint end)
{
    const uint count = end - first, all = (1u << count) - 1u;
    uint own_triangles[LANES];
    float lanes
        [6]
        [LANES];  // those without a leaf hold the first one's box, and are left out of what meets
    for (uint k = 0u; k < LANES; ++k) {
        const uint place = first + (k < count ? k : 0u);
        const Aabb box = leaf_box_of(FOREST, task.own, place);
        own_triangles[k] = leaf_triangle_of(FOREST, task.own, place);
        lanes[0][k] = box.min_x, lanes[1][k] = box.min_y, lanes[2][k] = box.min_z;
        lanes[3][k] = box.max_x, lanes[4][k] = box.max_y, lanes[5][k] = box.max_z;
    }
    const float8 min_x = vload8(0, lanes[0]), min_y = vload8(0, lanes[1]);
    const float8 min_z = vload8(0, lanes[2]), max_x = vload8(0, lanes[3]);
    const float8 max_y = vload8(0, lanes[4]), max_z = vload8(0, lanes[5]);
    const Aabb common = {least(min_x),   least(min_y),   least(min_z),
                         -least(-max_x), -least(-max_y), -least(-max_z)};
    const bool is_own = task.own == task.other;

    uint tests = is_own ? count * (count - 1u) / 2u : 0u;
    for (uint k = 1u; is_own && k < count; ++k) {
        const Aabb box = {lanes[0][k], lanes[1][k], lanes[2][k],
                          lanes[3][k], lanes[4][k], lanes[5][k]};
        const uint before = lanes_that_meet(min_x, min_y, min_z, max_x, max_y, max_z, box);
        put_lanes(faces, SINK_PASSED, own_triangles, before & ((1u << k) - 1u), own_triangles[k]);
    }
    PICK_TREE(task.other)
#if TREE_CHILD_BITS > 1u
    (void)ropes;
    const uint behind = is_own ? end : 0u;
    WideWalk walk;
    begin_walk(TREE, common, behind, &walk);
    tests += TREE_CHILDREN;
    for (uint leaf = next_leaf(TREE, common, behind, &walk, &tests); leaf != TREE_CHILDREN;
         leaf = next_leaf(TREE, common, behind, &walk, &tests)) {
        Aabb box;
        load_found_box(TREE, &walk, leaf, &box);
        const uint met = lanes_that_meet(min_x, min_y, min_z, max_x, max_y, max_z, box) & all;
        tests += count;
        if (met != 0u)
            put_lanes(faces, SINK_PASSED, own_triangles, met, found_triangle(TREE, &walk, leaf));
    }
#else
    const uint stop = walk_end(TREE, ropes);
    uint node = first_node(TREE, ropes, task, end - 1u);
    while (node != stop) {
        const Aabb box = tree_box(TREE, node);
        const bool is_leaf = tree_is_leaf(TREE, node);
        uint met = 0u;
        ++tests;
        if (overlap(common, box)) {
            met = lanes_that_meet(min_x, min_y, min_z, max_x, max_y, max_z, box) & all;
            tests += count;
        }
        if (met != 0u && is_leaf)
            put_lanes(faces, SINK_PASSED, own_triangles, met, tree_triangle(TREE, node));
        node = met != 0u && !is_leaf ? tree_left(TREE, node) : next_node(TREE, ropes, node);
    }
#endif
    return tests;
}

/// As in leaf_chunks.cl.
kernel void group_pairs(FOREST_PARAMETERS, global const uint* ropes, global const Face* faces,
                        global uint2* pairs, const uint capacity, volatile global uint* counters,
                        TASKS_PARAMETERS, global uint2* blocks)
{
    const Chunk chunk = own_chunk(task_count(TASKS, counters));
    uint block_count = 0u;
    ulong tests = 0ul;
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const QueryTask task = task_of(TASKS, counters, k);
        const uint end = task.first + task.count;
        for (uint place = task.first; place < end; place += LANES)
            tests += walk_with(FOREST, ropes, faces, SINK, task, place, min(place + LANES, end));
    }
    add_wide(counters + BOX_TESTS_COUNT, tests);
    empty_block(SINK);
}
