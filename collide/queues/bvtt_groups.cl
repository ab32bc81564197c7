// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DGROUP_SIZE=64u -DITEMS=4u -DONE_OBJECT=0 -DLABEL_BITS=20
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u -DITEMS=4u -DONE_OBJECT=1 -DLABEL_BITS=32
//
// A step of the traversal by work-groups: ITEMS tasks per work-item and iteration. A group buffers the output of an iteration in
// the lists of sinks/lists_groups.clh.
#include "collide/sinks/lists_groups.clh"

#include "collide/queues/bvtt.clh"

/// Expands the entries of `queue`, counted by the previous step. `next` receives the entries of the next step, `pairs` the pairs
/// found. What exceeds a capacity is counted, not written.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void expand(
    FOREST_PARAMETERS, global const uint* ropes, global const Face* faces, global uint2* pairs,
    const uint capacity, volatile global uint* counters, global const uint2* queue,
    global uint2* next, const uint queue_capacity, const uint step, const uint levels)
{
    local uint2 kept[KEPT];
    local uint kept_counts[2], counts[2], slots[2], tests[GROUP_SIZE];
    volatile global uint* sizes = counters + QUEUES_COUNT + 2u * step;
    const uint waiting = entries_of(sizes, queue_capacity, step);
    const ulong tasks = tasks_of(waiting, levels);
    const ulong a_turn = (ulong)get_num_groups(0) * KEPT;
    const uint turns = (uint)((tasks + a_turn - 1ul) / a_turn);
    const uint item = (uint)get_local_id(0);
    tests[item] = 0u;
    if (item < 2u)
        kept_counts[item] = 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint turn = 0u; turn < turns; ++turn) {
        const ulong first = ((ulong)turn * get_num_groups(0) + get_group_id(0)) * KEPT;
        for (uint k = 0u; k < ITEMS; ++k) {
            const ulong task = first + k * GROUP_SIZE + item;
            if (task < tasks)
                tests[item] += do_task(FOREST, faces, queue, step, levels, task, LISTS);
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        if (item < 2u)
            take_slots(kept_counts, item, counts, slots,
                       item == 0u ? sizes + 2 : counters + PAIRS_COUNT);
        barrier(CLK_LOCAL_MEM_FENCE);
        write_out(kept, 0u, 1, counts[0], next, slots[0], queue_capacity);
        write_out(kept, KEPT - 1u, -1, counts[1], pairs, slots[1], capacity);
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    count_tests(tests, counters);
    (void)ropes;
}
