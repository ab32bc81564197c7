// SPDX-License-Identifier: MIT
//
// Splits the leaves of blocks by cost, one block per work-item: the form of medians_groups.cl for devices with a few fast cores.
// Nodes are split in preorder. Up to FEW leaves are sorted along each axis once, because splitting a list preserves its order.
#include "builders/stages/medians/halve.clh"
#include "geometry/grid.h"

#define BLOCK_SLABS 128u  // of a node in a block
#define FEW_HEIGHT 4u
#define FEW (1u << FEW_HEIGHT)  // leaves that are compared with each other

/// Returns the box around the centres of some leaves. The fourth lane holds ids and is not used.
static inline Aabb box_of(global const uint4* leaves, const uint count)
{
    float4 low = (float4)(INFINITY);
    float4 high = -low;
    for (uint k = 0u; k < count; ++k) {
        low = fmin(low, as_float4(leaves[k]));
        high = fmax(high, as_float4(leaves[k]));
    }
    const Aabb box = {low.x, low.y, low.z, high.x, high.y, high.z};
    return box;
}

/// Splits the `count` leaves of a node in a block along an axis, where `box` holds their centres.
static inline void halve_along(global const uint4* from, global uint4* to, const Aabb box,
                               const uint axis, const uint count, const uint left,
                               local uint* const slab_counts)
{
    const uint slabs = min(count, BLOCK_SLABS);
    CellCut cut;
    cut.axis = axis;
    cut.low = low_side(box, axis);
    cut.slabs_per_unit = (float)slabs / (high_side(box, axis) - cut.low);
    cut.slab = 0u;
    halve(from, to, cut, slabs, count, left, slab_counts);
}

/// Returns the cost of some leaves as a half of a node.
static inline float cost_of(global const uint4* leaves, const uint count, const float scale)
{
    const Aabb box = box_of(leaves, count);
    return cost_of_half(box.max_x - box.min_x, box.max_y - box.min_y, box.max_z - box.min_z, scale,
                        count);
}

/// Splits the `count` leaves of a node in a block by cost.
static inline void halve_by_cost(global const uint4* from, global uint4* to, const uint count,
                                 const uint height, const float scale,
                                 local uint* const slab_counts)
{
    const uint left = left_count(count, height);
    if (left == count) {
        copy_leaves(from, to, count);
        return;
    }
    const Aabb box = box_of(from, count);
    float costs[3];
    for (uint axis = 0u; axis < 3u; ++axis) {
        halve_along(from, to, box, axis, count, left, slab_counts);
        const float left_cost = cost_of(to, left, scale);
        costs[axis] = left_cost + cost_of(to + left, count - left, scale);
    }
    const uint axis = cheapest_axis(costs[0], costs[1], costs[2]);
    if (axis != 2u)
        halve_along(from, to, box, axis, count, left, slab_counts);
}

/// Writes the list of each axis: the numbers of the FEW leaves, sorted along it. One vector comparison compares all leaves with one.
static inline void sort_few(const float16* const at, const uint16 ids, uint* const lists)
{
    int16 places[3] = {0, 0, 0};
    for (uint other = 0u; other < FEW; ++other) {
        const int16 is_later = ((const uint*)&ids)[other] < ids;
        for (uint axis = 0u; axis < 3u; ++axis) {
            const float there = ((const float*)&at[axis])[other];
            places[axis] -= (there < at[axis]) | ((there == at[axis]) & is_later);
        }
    }
    for (uint axis = 0u; axis < 3u; ++axis)
        for (uint k = 0u; k < FEW; ++k)
            lists[axis * FEW + (uint)((const int*)&places[axis])[k]] = k;
}

/// Returns the cost of the leaves at places `first` to `end` - 1 of a list, as a half of a node. Fourth lanes hold ids.
static inline float cost_of_few(const float4* const centres, const uint* const list,
                                const uint first, const uint end, const float scale)
{
    float4 low = centres[list[first]];
    float4 high = low;
    for (uint k = first + 1u; k < end; ++k) {
        low = fmin(low, centres[list[k]]);
        high = fmax(high, centres[list[k]]);
    }
    const float4 sides = high - low;
    return cost_of_half(sides.x, sides.y, sides.z, scale, end - first);
}

/// Splits the leaves at places `first` to `first` + `count` - 1 of the lists by cost: in each list, those that go left come first.
static inline void halve_few(const float4* const centres, uint* const lists, const uint first,
                             const uint count, const uint height, const float scale)
{
    const uint left = left_count(count, height);
    if (left == count)
        return;
    const uint middle = first + left;
    const uint end = first + count;
    float costs[3];
    for (uint axis = 0u; axis < 3u; ++axis)
        costs[axis] = cost_of_few(centres, lists + axis * FEW, first, middle, scale) +
                      cost_of_few(centres, lists + axis * FEW, middle, end, scale);
    const uint axis = cheapest_axis(costs[0], costs[1], costs[2]);
    uint are_left = 0u;  // one bit per leaf
    for (uint k = first; k < middle; ++k)
        are_left |= 1u << lists[axis * FEW + k];
    for (uint list = 0u; list < 3u; ++list) {
        uint moved[FEW];
        uint to_left = first;
        uint to_right = middle;
        for (uint k = first; k < end; ++k) {
            const uint leaf = lists[list * FEW + k];
            const uint is_left = are_left >> leaf & 1u;
            moved[is_left != 0u ? to_left : to_right] = leaf;
            to_left += is_left;
            to_right += 1u - is_left;
        }
        for (uint k = first; k < end; ++k)
            lists[list * FEW + k] = moved[k];
    }
}

/// Splits up to FEW leaves by cost, down to pairs, and writes their ids. All splits of two leaves cost nothing, so two leaves are in
/// the order of the first axis.
static inline void order_few(global const uint4* leaves, global uint* ids, const uint count,
                             const uint top, const float scale)
{
    float16 at[3];
    uint16 own_ids;
    float4 centres[FEW];
    for (uint k = 0u; k < FEW; ++k) {
        // Padding is last in every list.
        const uint4 leaf =
            k < count ? leaves[k] : leaf_of((Point){INFINITY, INFINITY, INFINITY}, 0x80000000u | k);
        centres[k] = as_float4(leaf);
        ((float*)&at[0])[k] = centres[k].x;
        ((float*)&at[1])[k] = centres[k].y;
        ((float*)&at[2])[k] = centres[k].z;
        ((uint*)&own_ids)[k] = leaf.w;
    }
    uint lists[3u * FEW];
    sort_few(at, own_ids, lists);
    for (uint height = top; height > 1u; --height)
        for (uint first = 0u; first < count; first += 1u << height)
            halve_few(centres, lists, first, min(1u << height, count - first), height, scale);
    for (uint k = 0u; k < count; ++k)
        ids[k] = leaves[lists[k]].w;
}

/// Puts the ids of every aligned run of 2^top leaves, one run per work-item, into the order of the median splits. `leaves` and
/// `others` are scratch, one leaf per id.
kernel void halve_blocks(global const float2* restrict boxes, global uint* restrict ids,
                         global uint4* leaves, global uint4* others, const uint count,
                         const uint top)
{
    local uint slab_counts[BLOCK_SLABS];
    const uint start = (uint)get_global_id(0) << top;
    const uint here = min(1u << top, count - start);
    global uint4* const even = leaves + start;
    global uint4* const odd = others + start;
    for (uint k = 0u; k < here; ++k)
        even[k] = leaf_of(box_centre(load_box(boxes, ids[start + k])), ids[start + k]);
    const float scale = scale_to_one(longest_side(box_of(even, here), 1.0f));
    const uint bottom = min(top, FEW_HEIGHT);
    for (uint first = 0u; first < here; first += 1u << bottom) {
        const uint highest = first == 0u ? top : lowest_bit(first);
        for (uint height = highest; height > bottom; --height) {
            const bool is_even = (top - height) % 2u == 0u;
            halve_by_cost((is_even ? even : odd) + first, (is_even ? odd : even) + first,
                          min(1u << height, here - first), height, scale, slab_counts);
        }
        order_few(((top - bottom) % 2u == 0u ? even : odd) + first, ids + start + first,
                  min(1u << bottom, here - first), bottom, scale);
    }
}
