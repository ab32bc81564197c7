// SPDX-License-Identifier: MIT
// check: -DKEEP_ADJACENT=0
// check: -DKEEP_ADJACENT=1
//
// Decides the pairs that no filter could decide, in exact arithmetic. One kernel serves both forms: it has no barriers, as PoCL
// 3.1 fails on barriers in a kernel with many helpers, and it uses an atomic per contact, which is cheap beside the test.
#include "collide/found.clh"
#include "collide/narrow/exact_adjacent.h"
#include "collide/narrow/narrow_words.h"
#include "collide/narrow/sharing.h"

/// Runs after filter_pairs, which wrote `unsure` and `counters`. Appends to `contacts`.
kernel void decide_exactly(global const Point* points, global const Face* faces,
                           global const uint2* unsure, const uint unsure_room,
                           global uint2* contacts, const uint contact_room,
                           volatile global uint* counters)
{
    const uint count = min(counters[NARROW_EXACT_COUNT], unsure_room);
    // Neighbouring candidates go to different groups, because the lanes of a warp take the branches of the test in turn.
    const ulong first = get_local_id(0) * get_num_groups(0) + get_group_id(0);
    for (ulong place = first; place < count; place += get_global_size(0)) {
        const uint2 pair = unsure[place];
        Shared shared = {0u, faces[pair.x], faces[pair.y]};
        if (KEEP_ADJACENT)
            shared = sharing(shared.a, shared.b);
        if (!corners_meet(corners_of(points, shared.a), corners_of(points, shared.b),
                          KEEP_ADJACENT ? shared.count : 0u))
            continue;
        const uint slot = add_wide(counters + CONTACTS_COUNT, 1u);
        if (slot < contact_room)
            contacts[slot] = pair;
    }
}
