// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DLABEL_BITS=20 -DSKIP_APART=1
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DLABEL_BITS=32 -DSKIP_APART=1
//
// As find_roots of roots.cl, for many objects in an order. A work-item sweeps from one object on.
#include "collide/object_order.clh"
#include "collide/queues/roots.cl"

kernel void sweep_roots(FOREST_PARAMETERS, ORDER_PARAMETERS, const uint within, global uint2* queue,
                        const uint capacity, volatile global uint* counters)
{
    const uint own = (uint)get_global_id(0);
    if (own >= object_count)
        return;
    const uint word = root_word(FOREST, own);
    const Aabb box = root_box(FOREST, own);
    if (within != 0u && !is_leaf_word(FOREST, word))
        push(queue, capacity, counters, (uint2)(word, word));
    ulong tests = 0ul;
    for (uint place = next_overlap(ORDER, box, ranks[own] + 1u, &tests); place < object_count;
         place = next_overlap(ORDER, box, place + 1u, &tests))
        push(queue, capacity, counters, (uint2)(word, root_word(FOREST, lined_up[place])));
    add_wide(counters + BOX_TESTS_COUNT, tests);
}
