// SPDX-License-Identifier: MIT
// check: -DRUN=1u -DKEEP_ADJACENT=0
// check: -DRUN=64u -DKEEP_ADJACENT=1
// check: -DRUN=64u -DKEEP_ADJACENT=1 -Xclang -cl-ext=-cl_khr_fp64,-__opencl_c_fp64
//
// Decides which candidates are within a distance (within.h). One kernel serves both forms: it has no barriers, and an atomic per pair is
// cheap beside the test. RUN: neighbouring candidates that a work-item takes at once.
#include "collide/found.clh"
#include "collide/narrow/narrow_words.h"
#include "collide/within/distance_filter.h"

#if HAS_DOUBLES

static inline void append(global uint2* list, const uint room, volatile global uint* count,
                          const uint2 pair)
{
    const uint slot = add_wide(count, 1ul);
    if (slot < room)
        list[slot] = pair;
}

/// `within` and `unsure` receive what fits; all are counted. `counters` must be zero. The square of the distance is from `low` to `high`.
kernel void decide_within(global const Point* points, global const Face* faces,
                          global const uint2* candidates, global const uint* candidate_counters,
                          const uint candidate_room, const double low, const double high,
                          global uint2* within, const uint within_room, global uint2* unsure,
                          const uint unsure_room, volatile global uint* counters)
{
    const uint count = count_in_room(candidate_counters + PAIRS_COUNT, candidate_room);
    for (ulong first = (ulong)RUN * get_global_id(0); first < count;
         first += (ulong)RUN * get_global_size(0))
        for (ulong place = first; place < min(first + RUN, (ulong)count); ++place) {
            const uint2 pair = candidates[place];
            const Face a = faces[pair.x], b = faces[pair.y];
            uint verdict = KEEP_ADJACENT ? VERDICT_MEET : VERDICT_APART;
            if (!share_a_vertex(a, b))
                verdict = likely_within(corners_of(points, a), corners_of(points, b), low, high);
            if (verdict == VERDICT_MEET)
                append(within, within_room, counters + CONTACTS_COUNT, pair);
            if (verdict == VERDICT_UNSURE)
                append(unsure, unsure_room, counters + NARROW_EXACT_COUNT, pair);
        }
}

#endif
