// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DSINK_BLOCK=512u -DONE_OBJECT=0 -DLABEL_BITS=20
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DSINK_BLOCK=512u -DONE_OBJECT=1 -DLABEL_BITS=32
//
// A step of the traversal in the chunk form: each work-item takes a contiguous run of tasks and has an output block per list.
#include "collide/sinks/lists_chunks.clh"

#include "collide/queues/bvtt.clh"

/// As `expand` in bvtt_groups.cl. `blocks` has 2 SINK_BLOCK pairs per work-item.
kernel void expand(FOREST_PARAMETERS, global const uint* ropes, global const Face* faces,
                   global uint2* pairs, const uint capacity, volatile global uint* counters,
                   global const uint2* queue, global uint2* next, const uint queue_capacity,
                   const uint step, const uint levels, global uint2* blocks)
{
    volatile global uint* sizes = counters + QUEUES_COUNT + 2u * step;
    const TaskRun run = own_run(tasks_of(entries_of(sizes, queue_capacity, step), levels));
    global uint2* own = blocks + 2u * SINK_BLOCK * get_global_id(0);
    Lists lists = {.nodes = {own, 0u, next, queue_capacity, sizes + 2},
                   .pairs = {own + SINK_BLOCK, 0u, pairs, capacity, counters + PAIRS_COUNT}};
    ulong tests = 0ul;
    for (ulong task = run.first; task < run.end; ++task)
        tests += do_task(FOREST, faces, queue, step, levels, task, &lists);
    close_sink(&lists.nodes);
    close_sink(&lists.pairs);
    add_wide(counters + BOX_TESTS_COUNT, tests);
    (void)ropes;
}
