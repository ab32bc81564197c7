// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DSINK_BLOCK=256u -DLABEL_BITS=20
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DSINK_BLOCK=256u -DLABEL_BITS=32
//
// A step of front tracking in the chunk form: a work-item takes a contiguous run of tasks and has one block of output each for
// sprouted nodes, front entries and pairs.
#include "collide/sinks/lists_chunks.clh"

#include "collide/front/front.clh"

/// As `advance` in front_groups.cl. `blocks` has 3 SINK_BLOCK pairs per work-item.
kernel void advance(FOREST_PARAMETERS, global const uint* ropes, global const Face* faces,
                    global uint2* pairs, const uint capacity, volatile global uint* counters,
                    global const uint2* parents, global const uint2* queue, global uint2* next,
                    const uint queue_capacity, global uint2* front, const uint front_capacity,
                    const uint step, const uint standing, const uint writes, global uint2* blocks)
{
    const TaskRun run = own_run(tasks_of(counters, standing, queue_capacity, step));
    global uint2* own = blocks + 3u * SINK_BLOCK * get_global_id(0);
    volatile global uint* next_count = counters + FRONT_QUEUES_COUNT + 2u * (step + 1u);
    Lists lists = {{own, 0u, next, queue_capacity, next_count},
                   {own + SINK_BLOCK, 0u, pairs, capacity, counters + PAIRS_COUNT},
                   {own + 2u * SINK_BLOCK, 0u, front, front_capacity, counters + FRONT_COUNT},
                   0ul};
    ulong tests = 0ul;
    for (ulong task = run.first; task < run.end; ++task)
        tests += do_task(FOREST, faces, parents, queue, step, writes, task, &lists);
    close_sink(&lists.nodes);
    close_sink(&lists.pairs);
    close_sink(&lists.entries);
    add_wide(counters + BOX_TESTS_COUNT, tests);
    add_wide(counters + PRUNES_COUNT, lists.prunes);
    (void)ropes;
}
