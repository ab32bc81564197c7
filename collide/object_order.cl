// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1
// check: -include oibvh/access.clh -DSORTED_LEAVES=1 -DBOX_FORMAT=1u
//
// What is before and after the sort of objects (object_order.h).
#include "collide/object_order.clh"
#include "collide/tree.clh"
#include "geometry/split.h"

/// Writes the sort key of each object: where its box begins.
kernel void begin_objects(FOREST_PARAMETERS, const uint object_count, const uint axis,
                          global uint* keys)
{
    const uint object = (uint)get_global_id(0);
    if (object < object_count)
        keys[object] = ordered_bits(begin_of(root_box(FOREST, object), axis));
}

/// Writes the boxes in their order, and the place of each object.
kernel void place_objects(FOREST_PARAMETERS, const uint object_count, global const uint* lined_up,
                          global uint* ranks, global BoxWord* ordered_boxes)
{
    const uint place = (uint)get_global_id(0);
    if (place >= object_count)
        return;
    const uint object = lined_up[place];
    ranks[object] = place;
    store_box(ordered_boxes, place, root_box(FOREST, object));
}
