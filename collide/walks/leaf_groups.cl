// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DGROUP_SIZE=64u
// check: -include oibvh/wide/wide8_access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u
// check: -include baselines/hploc/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u
// check: -include baselines/radix/access_apetrei.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u
//
// One work-group per task, one work-item per leaf: neighbouring leaves visit mostly the same nodes and write pairs together.
#include "collide/sinks/sink_groups.clh"

#include "collide/walks/leaf.clh"

/// `counters` are zero but for what between.cl added. `pairs` receives what fits; everything is counted.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void leaf_pairs(
    FOREST_PARAMETERS, global const uint* ropes, global const Face* faces, global uint2* pairs,
    const uint capacity, volatile global uint* counters, TASKS_PARAMETERS)
{
    OPEN_SINK
    local uint tests[GROUP_SIZE];
    barrier(CLK_LOCAL_MEM_FENCE);
    const QueryTask task = task_of(TASKS, counters, (uint)get_group_id(0));
    const uint item = (uint)get_local_id(0);
    tests[item] = 0u;
    if (item < task.count) {
        const uint place = task.first + item;
        const Aabb box = leaf_box_of(FOREST, task.own, place);
        const uint triangle = leaf_triangle_of(FOREST, task.own, place);
        PICK_TREE(task.other)
        tests[item] = walk_of(TREE, ropes, faces, SINK, box, triangle, task, place);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    count_tests(tests, counters);
    close_sink(SINK);
}
