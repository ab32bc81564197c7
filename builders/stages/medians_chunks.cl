// SPDX-License-Identifier: MIT
//
// Runs of leaves are halved at the exact median, each run by one work-item: the form of medians_groups.cl and
// kd_groups.cl for a few fast cores.
#include "geometry/box_words.clh"
#include "geometry/split.h"

static inline ulong middle_of(const ulong a, const ulong b, const ulong c)
{
    return max(min(a, b), min(max(a, b), c));
}

/// Hoare's selection: afterwards no key before `place` is larger than one from it on. Keys differ from each
/// other; `first` <= `place` <= `last`.
static inline void select_smallest(global ulong* keys, const int place, int first, int last)
{
    while (first < last) {
        const ulong pivot = middle_of(keys[first], keys[first + (last - first) / 2], keys[last]);
        int up = first;
        int down = last;
        while (up <= down) {
            while (keys[up] < pivot)
                ++up;
            while (keys[down] > pivot)
                --down;
            if (up <= down) {
                const ulong key = keys[up];
                keys[up++] = keys[down];
                keys[down--] = key;
            }
        }
        // Before `up` nothing is larger than the pivot, after `down` nothing smaller.
        if (place <= down)
            last = down;
        else if (place >= up)
            first = up;
        else
            last = first;
    }
}

/// Halve the `count` leaves from `first` on, if they are more than the left side holds.
static inline void halve(global const float2* boxes, global uint* ids, global ulong* keys,
                         const uint first, const uint count, const uint height)
{
    const uint left = left_count(count, height);
    if (left == count)
        return;
    Aabb box = empty_box();
    for (uint k = first; k < first + count; ++k)
        box = grown_to(box, box_centre(load_box(boxes, ids[k])));
    const uint axis = widest_axis(box);
    for (uint k = first; k < first + count; ++k)
        keys[k] = (ulong)split_key(box_centre(load_box(boxes, ids[k])), axis) << 32u | ids[k];
    select_smallest(keys, (int)(first + left), (int)first, (int)(first + count - 1u));
    for (uint k = first; k < first + count; ++k)
        ids[k] = (uint)keys[k];
}

/// Every aligned run of 2^top leaves, a work-item's own, is halved, its halves are halved, and so on down to
/// runs of 2^bottom. `keys` is scratch, one a leaf.
kernel void halve_runs(global const float2* restrict boxes, global uint* restrict ids,
                       global ulong* restrict keys, const uint count, const uint top,
                       const uint bottom)
{
    const uint start = (uint)get_global_id(0) << top;
    const uint here = min(1u << top, count - start);
    for (uint height = top; height >= bottom; --height)
        for (uint first = 0u; first < here; first += 1u << height)
            halve(boxes, ids, keys, start + first, min(1u << height, here - first), height);
}
