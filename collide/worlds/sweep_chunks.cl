// SPDX-License-Identifier: MIT
// check: -DAMONG=0 -DKEEP_ADJACENT=0 -DSINK_BLOCK=512u -DCODE_WORDS=1
// check: -DAMONG=1 -DKEEP_ADJACENT=0 -DSINK_BLOCK=512u -DCODE_WORDS=1
// check: -DAMONG=2 -DKEEP_ADJACENT=1 -DSINK_BLOCK=512u -DCODE_WORDS=2
//
// The chunk form: a work-item takes a contiguous run of places, and tests a box against eight at once.
#include "builders/stages/chunk.clh"
#include "collide/sinks/sink_chunks.clh"

#include "collide/worlds/eight.clh"
#include "collide/worlds/report.clh"
#include "collide/worlds/sweep.clh"

static inline Eight eight_in_rows(global const float* sides, const uint row_length,
                                  const uint place)
{
    const ulong row = row_length;
    Eight eight;
    eight.min_x = vload8(0, sides + place);
    eight.min_y = vload8(0, sides + row + place);
    eight.min_z = vload8(0, sides + 2ul * row + place);
    eight.max_x = vload8(0, sides + 3ul * row + place);
    eight.max_y = vload8(0, sides + 4ul * row + place);
    eight.max_z = vload8(0, sides + 5ul * row + place);
    return eight;
}

/// As `sweep_pairs` in sweep_groups.cl. `starts`: first place of each object, and `count`; with AMONG == 2, else all boxes are one object.
/// Rows are LANES longer than `count`. `blocks` has SINK_BLOCK pairs per work-item.
kernel void sweep_pairs(SWEEP_PARAMETERS, global uint2* blocks)
{
    const Chunk chunk = own_chunk(count);
    OPEN_SINK
    ulong tests = 0ul;
    for (uint place = chunk.first; place < chunk.end; ++place) {
        const uint limit = AMONG == 2 ? starts[owners[place] + 1u] : count;
        const Code end = ends[place];
        const Aabb box = box_in_rows(sides, row_length, place);
        for (uint other = place + 1u; other < limit && codes[other] <= end; other += LANES) {
            const uint lanes = min(LANES, limit - other);
            tests += lanes;
            const Eight eight = eight_in_rows(sides, row_length, other);
            uint hits = eight_meet(&eight, box) & ((1u << lanes) - 1u);
            for (; hits != 0u; hits &= hits - 1u)
                report(SINK, faces, owners, lined_up[place], lined_up[other + lowest_lane(hits)]);
        }
    }
    add_wide(counters + BOX_TESTS_COUNT, tests);
    close_sink(SINK);
}
