// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DLABEL_BITS=20 -DSKIP_APART=1 -DSWEEP_LANES=32u
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DLABEL_BITS=32 -DSKIP_APART=1 -DSWEEP_LANES=32u
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DLABEL_BITS=32 -DSKIP_APART=1 -DSWEEP_LANES=1u -DFILTERED=1 -DBETWEEN=0
//
// As find_roots of roots.cl, for many objects in an order. SWEEP_LANES work-items sweep from one object on. BETWEEN: whether pairs of
// two objects are wanted; 1 by default.
#define GROUP_SIZE 64u
#ifndef BETWEEN
#define BETWEEN 1
#endif
#include "collide/object_order.clh"
#include "collide/queues/roots.cl"

__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void sweep_roots(
    FOREST_PARAMETERS, ORDER_PARAMETERS, const uint within, global uint2* queue,
    const uint capacity, volatile global uint* counters)
{
    local ulong group_tests[GROUP_SIZE];
    const uint own = (uint)get_global_id(0) / SWEEP_LANES;
    const uint lane = (uint)get_global_id(0) % SWEEP_LANES;
    ulong tests = 0ul;
    if (own < object_count) {
        const uint word = root_word(FOREST, own);
        const Aabb box = root_box(FOREST, own);
        if (within != 0u && lane == 0u && !is_leaf_word(FOREST, word))
            if (!IS_EXCLUDED(own, own))
                push(queue, capacity, counters, (uint2)(word, word));
        const uint first = BETWEEN ? ranks[own] + lane + 1u : object_count;
        for (uint place = next_overlap(ORDER, box, own, first, &tests); place < object_count;
             place = next_overlap(ORDER, box, own, place + SWEEP_LANES, &tests))
            push(queue, capacity, counters, (uint2)(word, root_word(FOREST, lined_up[place])));
    }
    add_tests(group_tests, tests, counters + BOX_TESTS_COUNT);
}
