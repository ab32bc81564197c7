// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DGROUP_SIZE=64u -DTASK_LEAVES=64u -DSKIP_APART=1 -DSKIP_OVERLAP=1 -DSWEEP_LANES=32u
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DGROUP_SIZE=64u -DTASK_LEAVES=64u -DSKIP_APART=1 -DSKIP_OVERLAP=0 -DSWEEP_LANES=1u
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DGROUP_SIZE=64u -DTASK_LEAVES=64u -DSKIP_APART=1 -DSKIP_OVERLAP=1 -DSWEEP_LANES=32u -DFILTERED=1
//
// As between.cl, for many objects in an order: the leaves of the earlier object query the tree of the later one.
#include "collide/object_order.clh"
#include "collide/queues/between.cl"

__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void sweep_between(
    FOREST_PARAMETERS, ORDER_PARAMETERS, global const QueryTask* chunks, const uint chunk_count,
    global QueryTask* between, const uint most_between, volatile global uint* counters)
{
    local ulong group_tests[GROUP_SIZE];
    ulong tests = 0ul;
    const uint first = (uint)get_global_id(0) / SWEEP_LANES;
    const uint next = (uint)get_global_id(0) % SWEEP_LANES + 1u;
    for (uint k = first; k < chunk_count; k += (uint)get_global_size(0) / SWEEP_LANES) {
        QueryTask task = chunks[k];
        const Aabb box = SKIP_OVERLAP ? task_box(FOREST, task) : root_box(FOREST, task.own);
        for (uint place = next_overlap(ORDER, box, task.own, ranks[task.own] + next, &tests);
             place < object_count;
             place = next_overlap(ORDER, box, task.own, place + SWEEP_LANES, &tests)) {
            task.other = lined_up[place];
            const uint slot = add_wide(counters + TASKS_COUNT, 1ul);
            if (slot < most_between)
                between[slot] = task;
        }
    }
    add_tests(group_tests, tests, counters + BOX_TESTS_COUNT);
}
