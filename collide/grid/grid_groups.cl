// SPDX-License-Identifier: MIT
// check: -DAMONG=0 -DKEEP_ADJACENT=0 -DGROUP_SIZE=64u
// check: -DAMONG=2 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u
//
// The work-group form: one work-item per entry or per triangle. The neighbouring entries of a group read mostly the same memory.
#include "collide/sinks/sink_groups.clh"

#include "collide/grid/grid_walk.clh"

/// Finds the pairs of boxes of one level; `counters` must be zero. Also sets the count at QUEUES_COUNT to the number of entries.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void cell_pairs(
    TABLE_PARAMETERS, global uint2* pairs, const uint capacity, volatile global uint* counters)
{
    OPEN_SINK
    local uint tests[GROUP_SIZE];
    const uint item = (uint)get_local_id(0);
    if (get_global_id(0) == 0)
        counters[QUEUES_COUNT] = ends[(1u << (32u - shift)) - 1u];
    const uint count = entry_count(TABLE);
    if ((uint)get_group_id(0) * GROUP_SIZE >= count)
        return;
    barrier(CLK_LOCAL_MEM_FENCE);
    tests[item] = 0u;
    if (get_global_id(0) < count)
        tests[item] = meet_behind(TABLE, SINK, (uint)get_global_id(0));
    barrier(CLK_LOCAL_MEM_FENCE);
    count_tests(tests, counters);
    close_sink(SINK);
}

/// Adds the pairs of boxes of two different levels.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void level_pairs(
    TABLE_PARAMETERS, global uint2* pairs, const uint capacity, volatile global uint* counters,
    const uint triangles)
{
    OPEN_SINK
    local uint tests[GROUP_SIZE];
    const uint item = (uint)get_local_id(0);
    const uint levels = grid->levels;
    if (levels == 1u)
        return;  // only level 0 has boxes
    barrier(CLK_LOCAL_MEM_FENCE);
    tests[item] = 0u;
    if (get_global_id(0) < triangles)
        tests[item] = meet_coarser(TABLE, SINK, load_box(boxes, (uint)get_global_id(0)),
                                   (uint)get_global_id(0));
    barrier(CLK_LOCAL_MEM_FENCE);
    count_tests(tests, counters);
    close_sink(SINK);
}
