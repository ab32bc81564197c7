// SPDX-License-Identifier: MIT
//
// Takes the pairs that no filter could decide for contacts. One kernel serves both forms: it has no barriers, and one atomic a work-item.
#include "collide/found.clh"
#include "collide/narrow/narrow_words.h"

/// Runs after filter_pairs, which wrote `unsure` and `counters`. Appends to `contacts`.
kernel void keep_undecided(global const uint2* unsure, const uint unsure_room,
                           global uint2* contacts, const uint contact_room,
                           volatile global uint* counters)
{
    const uint count = min(counters[NARROW_EXACT_COUNT], unsure_room);
    const uint first = (uint)get_global_id(0), step = (uint)get_global_size(0);
    if (first >= count)
        return;
    uint slot = add_wide(counters + CONTACTS_COUNT, (count - 1u - first) / step + 1u);
    for (ulong place = first; place < count; place += step, ++slot)
        if (slot < contact_room)
            contacts[slot] = unsure[place];
}
