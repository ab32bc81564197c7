// SPDX-License-Identifier: MIT
//
// Leaves are halved at exact medians, each run of them by one work-item: the form of medians_groups.cl and cells_groups.cl
// for a few fast cores.
#include "builders/stages/medians/cells.clh"
#include "geometry/box_words.clh"
#include "geometry/grid.h"

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

/// Select along an axis: afterwards the lower words of `keys` are the ids of the `count` leaves from `first`
/// on, those that go left before the others.
static inline void select_left(global const float2* boxes, global const uint* ids,
                               global ulong* keys, const uint axis, const uint first,
                               const uint count, const uint left)
{
    for (uint k = first; k < first + count; ++k)
        keys[k] = (ulong)split_key(box_centre(load_box(boxes, ids[k])), axis) << 32u | ids[k];
    select_smallest(keys, (int)(first + left), (int)first, (int)(first + count - 1u));
}

/// Halve the `count` leaves from `first` on, those of a node, and leave its children's cells.
static inline void halve_by_cell(global const float2* boxes, global uint* ids, global ulong* keys,
                                 global Aabb* cells, const uint first, const uint count,
                                 const uint level, const uint height)
{
    const uint node = first_node(level) + (first >> height);
    const uint child = first_node(level + 1u) + 2u * (first >> height);
    const uint left = left_count(count, height);
    const Aabb cell = cells[node];
    if (left == count) {
        cells[child] = cell;
        return;
    }
    const uint slabs = slab_count(level, height);
    CellCut cut = cut_of_cell(cell, slabs);
    select_left(boxes, ids, keys, cut.axis, first, count, left);
    for (uint k = first; k < first + left; ++k) {
        const Point centre = box_centre(load_box(boxes, (uint)keys[k]));
        cut.slab = max(cut.slab, slab_of(cut, coordinate(centre, cut.axis), slabs));
    }
    for (uint k = first; k < first + count; ++k)
        ids[k] = (uint)keys[k];
    cells[child] = left_cell(cell, cut, slabs);
    cells[child + 1u] = right_cell(cell, cut, slabs);
}

/// The nodes on `level`, a work-item each, are halved, their children are, and so on down to what is
/// 2^(bottom - 1) leaves high. `keys` is scratch, one a leaf; `cells` of a level are known.
kernel void halve_nodes(global const float2* restrict boxes, global const Bounds* restrict bounds,
                        global uint* restrict ids, global ulong* restrict keys,
                        global Aabb* restrict cells, const uint count, const uint root_height,
                        const uint level, const uint bottom)
{
    const uint top = root_height - level;
    const uint start = (uint)get_global_id(0) << top;
    const uint here = min(1u << top, count - start);
    if (level == 0u)
        cells[0] = bounds->centres;
    for (uint height = top; height >= bottom; --height)
        for (uint first = 0u; first < here; first += 1u << height)
            halve_by_cell(boxes, ids, keys, cells, start + first, min(1u << height, here - first),
                          root_height - height, height);
}

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
static inline void halve_by_cost(global const float2* boxes, global uint* ids, global ulong* keys,
                                 const uint first, const uint count, const uint height,
                                 const float scale)
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
            halve_by_cost(boxes, ids, keys, start + first, min(1u << height, here - first), height,
                          scale);
}
