// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DGROUP_SIZE=64u
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u
// check: -include baselines/radix/access_apetrei.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u
//
// A work-item a leaf; a group's neighbouring leaves walk much the same nodes and write their pairs together.
#include "collide/sink_groups.clh"
#include "collide/sum_tests.clh"

#include "collide/leaf.clh"

/// `counters` are zero. Afterwards `pairs` begin with all of them, if there was room.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void leaf_pairs(
    TREE_PARAMETERS, global const uint* ropes, global const Face* faces, global uint2* pairs,
    const uint capacity, volatile global uint* counters)
{
    SINK_LOCAL
    local uint tests[GROUP_SIZE];
    open_sink(&kept_count);
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint place = (uint)get_global_id(0);
    tests[get_local_id(0)] = place < leaves ? walk_from(TREE, ropes, faces, SINK, place) : 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    count_tests(tests, counters);
    close_sink(SINK);
}
