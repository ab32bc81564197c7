// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DGROUP_SIZE=64u -DITEMS=4u -DLABEL_BITS=20
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u -DITEMS=4u -DLABEL_BITS=32
//
// A step of front tracking by work-groups: ITEMS tasks per work-item and iteration. A group buffers the output of an iteration in
// the lists of sinks/lists_groups.clh: sprouted nodes, pairs, and front entries.
#include "collide/sinks/lists_groups.clh"

#include "collide/front/front.clh"

/// Advances the front by a step. In step 0, `queue` is the current front of `standing` entries; later it holds the nodes that the
/// previous step queued. `next` receives the entries of the next step, `pairs` the pairs found, and if `writes` is set `front` the
/// entries of the next front. What exceeds a capacity is counted, not written.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void advance(
    FOREST_PARAMETERS, global const uint* ropes, global const Face* faces, global uint2* pairs,
    const uint capacity, volatile global uint* counters, global const uint2* parents,
    global const uint2* queue, global uint2* next, const uint queue_capacity, global uint2* front,
    const uint front_capacity, const uint step, const uint standing, const uint writes,
    global uint2* blocks)
{
    local uint2 kept[2u * KEPT];
    local uint kept_counts[4], counts[4], slots[4], tests[GROUP_SIZE];
    const ulong tasks = tasks_of(counters, standing, queue_capacity, step);
    const ulong a_turn = (ulong)get_num_groups(0) * KEPT;
    const uint turns = (uint)((tasks + a_turn - 1ul) / a_turn);
    const uint item = (uint)get_local_id(0);
    tests[item] = 0u;
    if (item < 4u)
        kept_counts[item] = 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint turn = 0u; turn < turns; ++turn) {
        const ulong first = ((ulong)turn * get_num_groups(0) + get_group_id(0)) * KEPT;
        for (uint k = 0u; k < ITEMS; ++k) {
            const ulong task = first + k * GROUP_SIZE + item;
            if (task < tasks)
                tests[item] += do_task(FOREST, faces, parents, queue, step, writes, task, LISTS);
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        if (item < 4u) {
            const uint places[4] = {FRONT_QUEUES_COUNT + 2u * (step + 1u), PAIRS_COUNT, FRONT_COUNT,
                                    PRUNES_COUNT};
            take_slots(kept_counts, item, counts, slots, counters + places[item]);
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        write_out(kept, 0u, 1, counts[0], next, slots[0], queue_capacity);
        write_out(kept, KEPT - 1u, -1, counts[1], pairs, slots[1], capacity);
        write_out(kept, KEPT, 1, counts[2], front, slots[2], front_capacity);
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    count_tests(tests, counters);
    (void)ropes, (void)blocks;
}
