// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DGROUP_SIZE=64u
// check: -include oibvh/wide/wide8_access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DGROUP_SIZE=1u
// check: -include baselines/radix/access_apetrei.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u
//
// Tests triangles of other ranks against the tree of this one: one work-item per box.
#include "collide/sinks/sink_groups.clh"

#include "collide/walks/leaf.clh"
#include "geometry/box_words.clh"

/// Triangle k of the halo, of `halo_count`, has the number `own_count` + k, also in `faces`, whose vertices are numbered as in the
/// scene. `counters` are zero. `pairs` receives what fits; everything is counted.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void halo_pairs(
    FOREST_PARAMETERS, global const uint* ropes, global const Face* faces, global uint2* pairs,
    const uint capacity, volatile global uint* counters, global const BoxWord* halo,
    const uint halo_count, const uint own_count)
{
    OPEN_SINK
    local uint tests[GROUP_SIZE];
    barrier(CLK_LOCAL_MEM_FENCE);
    const QueryTask from_outside = {1u, 0u, 0u, 0u};  // no leaves of the tree's own
    const uint k = (uint)get_global_id(0), item = (uint)get_local_id(0);
    tests[item] = 0u;
    if (k < halo_count) {
        PICK_TREE(0u)
        tests[item] =
            walk_of(TREE, ropes, faces, SINK, load_box(halo, k), own_count + k, from_outside, 0u);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    count_tests(tests, counters);
    close_sink(SINK);
}
