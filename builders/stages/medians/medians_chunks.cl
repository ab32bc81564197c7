// SPDX-License-Identifier: MIT
//
// Runs of leaves are halved at the exact median, each run by one work-item: the form of medians_groups.cl and
// cells_groups.cl for a few fast cores.
#include "builders/stages/medians/select.clh"
#include "geometry/grid.h"

/// What the leaves with `count` keys from `first` on cost as a half of a node.
static inline float cost_of_keys(global const float2* boxes, global const ulong* keys,
                                 const uint first, const uint count, const float scale)
{
    Aabb box = empty_box();
    for (uint k = first; k < first + count; ++k)
        box = grown_to(box, box_centre(load_box(boxes, (uint)keys[k])));
    return cost_of_half(box.max_x - box.min_x, box.max_y - box.min_y, box.max_z - box.min_z, scale,
                        count);
}

/// Halve the `count` leaves from `first` on by cost, if they are more than the left side holds.
static inline void halve(global const float2* boxes, global uint* ids, global ulong* keys,
                         const uint first, const uint count, const uint height, const float scale)
{
    const uint left = left_count(count, height);
    if (left == count)
        return;
    uint axis = 0u;
    if (height > 1u) {  // two leaves cost nothing however they are cut
        float costs[3];
        for (axis = 0u; axis < 3u; ++axis) {
            select_left(boxes, ids, keys, axis, first, count, left);
            const float left_cost = cost_of_keys(boxes, keys, first, left, scale);
            costs[axis] = left_cost + cost_of_keys(boxes, keys, first + left, count - left, scale);
        }
        axis = cheapest_axis(costs[0], costs[1], costs[2]);
    }
    if (axis != 2u || height == 1u)
        select_left(boxes, ids, keys, axis, first, count, left);
    for (uint k = first; k < first + count; ++k)
        ids[k] = (uint)keys[k];
}

/// Every aligned run of 2^top leaves, a work-item's own, is halved, its halves are halved, and so on.
/// `keys` is scratch, one a leaf.
kernel void halve_blocks(global const float2* restrict boxes, global uint* restrict ids,
                         global ulong* restrict keys, const uint count, const uint top)
{
    const uint start = (uint)get_global_id(0) << top;
    const uint here = min(1u << top, count - start);
    Aabb box = empty_box();
    for (uint k = start; k < start + here; ++k)
        box = grown_to(box, box_centre(load_box(boxes, ids[k])));
    const float scale = scale_to_one(longest_side(box, 1.0f));
    for (uint height = top; height > 0u; --height)
        for (uint first = 0u; first < here; first += 1u << height)
            halve(boxes, ids, keys, start + first, min(1u << height, here - first), height, scale);
}
