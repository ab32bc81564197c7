// SPDX-License-Identifier: MIT
// check: -DKEEP_ADJACENT=0
// check: -DKEEP_ADJACENT=1
//
// Decides the pairs that find_first left unsure, as collide/narrow/narrow_exact.cl, up to the first that meets.
#include "collide/first/flag.clh"
#include "collide/narrow/exact_adjacent.h"
#include "collide/narrow/sharing.h"

/// If there is an answer afterwards, UNSURE_COUNT is 0: a list that was too short then does no harm.
kernel void decide_first(global const Point* points, global const Face* faces,
                         global const uint2* unsure, const uint unsure_room, global uint2* pairs,
                         volatile global uint* counters)
{
    const uint count = min(counters[UNSURE_COUNT], unsure_room);
    for (ulong place = get_global_id(0); place < count && !is_found(counters);
         place += get_global_size(0)) {
        const uint2 pair = unsure[place];
        Shared shared = {0u, faces[pair.x], faces[pair.y]};
        if (KEEP_ADJACENT)
            shared = sharing(shared.a, shared.b);
        if (corners_meet(corners_of(points, shared.a), corners_of(points, shared.b),
                         KEEP_ADJACENT ? shared.count : 0u))
            answer(counters, pairs, pair);
    }
    if (is_found(counters)) {
        atomic_xchg(counters + UNSURE_COUNT, 0u);
        atomic_xchg(counters + UNSURE_COUNT + 1u, 0u);
    }
}
