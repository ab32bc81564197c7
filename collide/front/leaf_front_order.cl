// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DLABEL_BITS=20
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DLABEL_BITS=32
//
// The last step of the sort by counting of a front: `places` has the place of each bin's first entry.
#include "collide/counters.h"
#include "collide/front/leaf_front_bins.clh"

/// Copies the entries of `front`, as many as counted, to `ordered`. Entries of a bin are in no order.
kernel void order_entries(FOREST_PARAMETERS, global const uint2* front, const uint room,
                          global const uint* counters, volatile global uint* places,
                          global uint2* ordered)
{
    const uint count = counters[FRONT_COUNT + 1u] != 0u ? room : min(counters[FRONT_COUNT], room);
    for (uint k = (uint)get_global_id(0); k < count; k += (uint)get_global_size(0)) {
        const uint2 entry = front[k];
        const uint object = object_of(entry.y);
        PICK_TREE(object)
        const uint place =
            atomic_inc(places + first_bin(objects, object) + bin_in_tree(TREE, node_of(entry.y)));
        if (place < room)
            ordered[place] = entry;
    }
}
