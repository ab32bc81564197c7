// SPDX-License-Identifier: MIT
//
// Splits leaves at exact medians, one run per work-item: the form of medians_groups.cl and cells_groups.cl for devices with a
// few fast cores.
#include "builders/stages/medians/cells.clh"
#include "geometry/box_words.clh"
#include "geometry/grid.h"

static inline ulong middle_of(const ulong a, const ulong b, const ulong c)
{
    return max(min(a, b), min(max(a, b), c));
}

/// Hoare's selection: afterwards no key before `place` is larger than a key at or after it. Keys are distinct; `first` <=
/// `place` <= `last`.
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
        // No key before `up` is larger than the pivot, and none after `down` is smaller.
        if (place <= down)
            last = down;
        else if (place >= up)
            first = up;
        else
            last = first;
    }
}

/// Selects along an axis: afterwards the lower words of `keys` are the ids of the `count` leaves from `first` on, with the
/// `left` leaves that go left first.
static inline void select_left(global const float2* boxes, global const uint* ids,
                               global ulong* keys, const uint axis, const uint first,
                               const uint count, const uint left)
{
    for (uint k = first; k < first + count; ++k)
        keys[k] = (ulong)split_key(box_centre(load_box(boxes, ids[k])), axis) << 32u | ids[k];
    select_smallest(keys, (int)(first + left), (int)first, (int)(first + count - 1u));
}

/// Splits the `count` leaves of a node, from `first` on, and stores its children's cells.
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

/// Splits the nodes on `level`, one per work-item, then their children, and so on down to nodes at height `bottom`, which are
/// split last. `keys` is scratch, one per leaf; the cells of `level` must be known (level 0 sets the root's).
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

/// Returns the cost, as a half of a node, of the leaves of the `count` keys from `first` on.
static inline float cost_of_keys(global const float2* boxes, global const ulong* keys,
                                 const uint first, const uint count, const float scale)
{
    Aabb box = empty_box();
    for (uint k = first; k < first + count; ++k)
        box = grown_to(box, box_centre(load_box(boxes, (uint)keys[k])));
    return cost_of_half(box.max_x - box.min_x, box.max_y - box.min_y, box.max_z - box.min_z, scale,
                        count);
}

/// Splits the `count` leaves from `first` on by cost, if the left side cannot hold them all.
static inline void halve_by_cost(global const float2* boxes, global uint* ids, global ulong* keys,
                                 const uint first, const uint count, const uint height,
                                 const float scale)
{
    const uint left = left_count(count, height);
    if (left == count)
        return;
    uint axis = 0u;
    if (height > 1u) {  // with two leaves, every split costs nothing
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

/// Splits every aligned run of 2^top leaves, one per work-item, then its halves, and so on. `keys` is scratch, one per leaf.
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
