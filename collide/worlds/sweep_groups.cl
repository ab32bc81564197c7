// SPDX-License-Identifier: MIT
// check: -DAMONG=0 -DKEEP_ADJACENT=0 -DGROUP_SIZE=64u -DSWEEP_LANES=8u -DCODE_WORDS=1
// check: -DAMONG=1 -DKEEP_ADJACENT=0 -DGROUP_SIZE=64u -DSWEEP_LANES=1u -DCODE_WORDS=1
// check: -DAMONG=2 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u -DSWEEP_LANES=32u -DCODE_WORDS=2
//
// The work-group form: SWEEP_LANES neighbouring work-items share the sweep from a box on, and each takes every SWEEP_LANES-th place.
#include "collide/sinks/sink_groups.clh"

#include "collide/worlds/report.clh"
#include "collide/worlds/sweep.clh"

/// Finds the pairs of boxes by a sweep from each to the last box that begins before it ends; `counters` must be zero. `starts` is not used.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void sweep_pairs(SWEEP_PARAMETERS)
{
    OPEN_SINK
    local ulong tests[GROUP_SIZE];
    (void)starts;
    ulong own_tests = 0ul;
    const uint place = (uint)(get_global_id(0) / SWEEP_LANES);
    barrier(CLK_LOCAL_MEM_FENCE);
    if (place < count) {
        const Aabb box = box_in_rows(sides, row_length, place);
        const Code end = ends[place];
        const uint triangle = lined_up[place];
        uint other = place + 1u + (uint)get_global_id(0) % SWEEP_LANES;
        for (; other < count && codes[other] <= end; other += SWEEP_LANES) {
            ++own_tests;
            if (overlap(box, box_in_rows(sides, row_length, other)))
                report(SINK, faces, owners, triangle, lined_up[other]);
        }
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    add_tests(tests, own_tests, counters + BOX_TESTS_COUNT);
    close_sink(SINK);
}
