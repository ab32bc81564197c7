// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DLABEL_BITS=20 -DSKIP_APART=1
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DLABEL_BITS=32 -DSKIP_APART=0
//
// Initial entries of traversals over pairs of nodes with several objects: each root with itself if pairs within objects are
// wanted, and the roots of two objects if pairs between objects are.
#include "collide/found.clh"
#include "collide/queues/nodes.clh"
#include "collide/walks/task.h"
#include "geometry/bits.h"

static inline void push(global uint2* queue, const uint capacity, volatile global uint* counters,
                        const uint2 entry)
{
    const uint slot = add_wide(counters + QUEUES_COUNT, 1ul);
    if (slot < capacity)
        queue[slot] = entry;
}

/// Writes the first queue of bvtt: inner roots with themselves, untested, and pairs of roots whose boxes overlap; without
/// SKIP_APART (skips.h) all pairs of roots. A work-item tests one object against OTHERS_AT_A_TIME objects.
kernel void find_roots(FOREST_PARAMETERS, const uint object_count, const uint within,
                       const uint between, global uint2* queue, const uint capacity,
                       volatile global uint* counters)
{
    const uint blocks = divided_up(object_count, OTHERS_AT_A_TIME);
    const uint own = (uint)get_global_id(0) / blocks;
    const uint first = (uint)get_global_id(0) % blocks * OTHERS_AT_A_TIME;
    if (own >= object_count)
        return;
    const uint word = root_word(FOREST, own);
    const Aabb box = root_box(FOREST, own);
    if (within != 0u && first == 0u && !is_leaf_word(FOREST, word))
        push(queue, capacity, counters, (uint2)(word, word));
    const uint end = between != 0u ? min(object_count, first + OTHERS_AT_A_TIME) : 0u;
    uint tests = 0u;
    for (uint other = max(first, own + 1u); other < end; ++other) {
        ++tests;
        const Aabb others = root_box(FOREST, other);
        if (!SKIP_APART || overlap(box, others))
            push(queue, capacity, counters, (uint2)(word, root_word(FOREST, other)));
    }
    add_wide(counters + BOX_TESTS_COUNT, tests);
}

/// Writes the initial front: all these pairs of roots, including leaves and disjoint boxes, since objects may come into contact
/// later. One work-item per ordered pair of objects, object_count^2 in all; `front` has room for every entry.
kernel void list_roots(FOREST_PARAMETERS, const uint object_count, const uint within,
                       const uint between, global uint2* front)
{
    const ulong count = object_count, all_between = count * (count - 1ul) / 2ul;
    const ulong a = get_global_id(0) / count, b = get_global_id(0) % count;
    if (a >= count || (a == b ? within == 0u : a > b || between == 0u))
        return;
    const ulong slot = a == b ? (between != 0u ? all_between : 0ul) + a
                              : a * (2ul * count - a - 1ul) / 2ul + (b - a - 1ul);
    front[slot] = (uint2)(root_word(FOREST, (uint)a), root_word(FOREST, (uint)b));
}
