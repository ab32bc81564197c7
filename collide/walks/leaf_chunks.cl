// SPDX-License-Identifier: MIT
// check: -include baselines/perfect/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=0 -DSINK_BLOCK=512u
// check: -include oibvh/wide/wide8_access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=1 -DSINK_BLOCK=512u
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=1 -DSINK_BLOCK=512u
//
// The chunk form: a work-item takes a contiguous run of tasks, leaf after leaf.
#include "builders/stages/chunk.clh"
#include "collide/sinks/sink_chunks.clh"

#include "collide/walks/leaf.clh"

/// As `leaf_pairs` in leaf_groups.cl. `blocks` has SINK_BLOCK pairs per work-item.
kernel void leaf_pairs(FOREST_PARAMETERS, global const uint* ropes, global const Face* faces,
                       global uint2* pairs, const uint capacity, volatile global uint* counters,
                       TASKS_PARAMETERS, global uint2* blocks)
{
    const Chunk chunk = own_chunk(task_count(TASKS, counters));
    OPEN_SINK
    ulong tests = 0ul;
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const QueryTask task = task_of(TASKS, counters, k);
        PICK_TREE(task.other)
        for (uint place = task.first; place < task.first + task.count; ++place) {
            const Aabb box = leaf_box_of(FOREST, task.own, place);
            tests += walk_of(TREE, ropes, faces, SINK, box,
                             leaf_triangle_of(FOREST, task.own, place), task, place);
        }
    }
    add_wide(counters + BOX_TESTS_COUNT, tests);
    close_sink(SINK);
}
