// SPDX-License-Identifier: MIT
// check: -DSINK_BLOCK=512u -DROUNDED_TEST=1 -DREAL_BITS=32
// check: -DSINK_BLOCK=512u -DROUNDED_TEST=2 -DREAL_BITS=32 -Xclang -cl-ext=-cl_khr_fp64,-__opencl_c_fp64
// check: -DSINK_BLOCK=512u -DROUNDED_TEST=2 -DREAL_BITS=64
// check: -DSINK_BLOCK=512u -DROUNDED_TEST=3 -DREAL_BITS=32 -Xclang -cl-ext=-cl_khr_fp64,-__opencl_c_fp64
//
// As narrow_chunks.cl, for tests in rounded arithmetic: pair by pair, since these tests branch. No candidate is unsure.
#include "collide/narrow/rounded.clh"
#include "collide/sinks/sink_chunks.clh"

#define BATCH 256u

kernel void filter_pairs(global const Point* points, global const Face* faces,
                         global const uint2* candidates, global const uint* candidate_counters,
                         const uint candidate_room, global uint2* contacts, const uint contact_room,
                         global uint2* unsure, const uint unsure_room,
                         volatile global uint* counters, global uint* next_counters,
                         global uint2* blocks)
{
    zero_next(next_counters, NARROW_COUNTERS);
    (void)unsure, (void)unsure_room;
    const uint count = count_in_room(candidate_counters, candidate_room);
    List meeting = {blocks + SINK_BLOCK * get_global_id(0), 0u, contacts, contact_room,
                    counters + CONTACTS_COUNT};
    uint looked_at = 0u;
    for (ulong first = (ulong)BATCH * atomic_inc(counters + BATCHES_BEGUN); first < count;
         first = (ulong)BATCH * atomic_inc(counters + BATCHES_BEGUN)) {
        const uint in_batch = (uint)min((ulong)BATCH, count - first);
        looked_at += in_batch;
        for (uint k = 0u; k < in_batch; ++k) {
            const uint2 pair = candidates[first + k];
            if ((first_verdict(points, faces[pair.x], faces[pair.y]) & VERDICT_MEET) != 0u)
                put(&meeting, pair);
        }
    }
    close_sink(&meeting);
    add_wide(counters + (REAL_BITS == 64 ? NARROW_DOUBLE_COUNT : NARROW_FLOAT_COUNT), looked_at);
}
