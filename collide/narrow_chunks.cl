// SPDX-License-Identifier: MIT
// check: -DSINK_BLOCK=512u -DKEEP_ADJACENT=0 -DWITH_DOUBLES=1
// check: -DSINK_BLOCK=512u -DKEEP_ADJACENT=1 -DWITH_DOUBLES=1
// check: -DSINK_BLOCK=512u -DKEEP_ADJACENT=1 -DWITH_DOUBLES=0 -Xclang -cl-ext=-cl_khr_fp64,-__opencl_c_fp64
//
// Candidates in runs: one run a work-item, which keeps contacts and unsure ones in a block each.
#include "builders/stages/chunk.clh"
#include "collide/sink_chunks.clh"
#include "collide/verdict.clh"

/// As in narrow_groups.cl. `blocks` has room for 2 SINK_BLOCK pairs a work-item.
kernel void filter_pairs(global const Point* points, global const Face* faces,
                         global const uint2* candidates, global const uint* candidate_counters,
                         const uint candidate_room, global uint2* contacts, const uint contact_room,
                         global uint2* unsure, const uint unsure_room,
                         volatile global uint* counters, global uint2* blocks)
{
    const Chunk chunk = own_chunk(candidate_count(candidate_counters, candidate_room));
    global uint2* const meeting = blocks + 2u * SINK_BLOCK * get_global_id(0);
    global uint2* const doubtful = meeting + SINK_BLOCK;
    uint meeting_count = 0u, doubtful_count = 0u;
    uint by_floats = 0u, by_doubles = 0u;
    for (uint place = chunk.first; place < chunk.end; ++place) {
        const uint2 pair = candidates[place];
        const uint verdict = first_verdict(points, faces[pair.x], faces[pair.y]);
        by_doubles += verdict & BY_DOUBLES ? 1u : 0u;
        by_floats += verdict == VERDICT_APART || verdict == VERDICT_MEET ? 1u : 0u;
        if ((verdict & VERDICT_MEET) != 0u)
            put(meeting, &meeting_count, contacts, contact_room, counters + CONTACTS_COUNT, pair);
        if ((verdict & VERDICT_UNSURE) != 0u)
            put(doubtful, &doubtful_count, unsure, unsure_room, counters + NARROW_EXACT_COUNT,
                pair);
    }
    empty_block(meeting, &meeting_count, contacts, contact_room, counters + CONTACTS_COUNT);
    empty_block(doubtful, &doubtful_count, unsure, unsure_room, counters + NARROW_EXACT_COUNT);
    add_wide(counters + NARROW_FLOAT_COUNT, by_floats);
    add_wide(counters + NARROW_DOUBLE_COUNT, by_doubles);
}
