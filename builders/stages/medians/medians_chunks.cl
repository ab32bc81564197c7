// SPDX-License-Identifier: MIT
// check: -DBLOCK_HEIGHT=10u
//
// Splits the leaves of blocks by cost, one block per work-item: the form of medians_groups.cl for devices with a few fast cores. All of
// a block fits the nearest cache. Its leaves are sorted along each axis once, because splitting a list preserves its order.
#include "geometry/box_words.clh"
#include "geometry/grid.h"
#include "geometry/split.h"

#define BLOCK (1u << BLOCK_HEIGHT)  // leaves
#define DIGIT_BITS 8u
#define DIGITS (1u << DIGIT_BITS)
#define PASSES (32u / DIGIT_BITS)

/// Sorts the numbers of `count` leaves by their keys. Equal keys keep their order. Digits that all keys share are left out.
static inline void sort_list(const uint* const keys, ushort* const list, const uint count)
{
    uint places[PASSES][DIGITS] = {{0u}};
    for (uint k = 0u; k < count; ++k)
        for (uint pass = 0u; pass < PASSES; ++pass)
            ++places[pass][keys[k] >> pass * DIGIT_BITS & (DIGITS - 1u)];
    for (uint pass = 0u; pass < PASSES; ++pass) {
        const uint shift = pass * DIGIT_BITS;
        if (places[pass][keys[0] >> shift & (DIGITS - 1u)] == count)
            continue;
        for (uint digit = 0u, before = 0u; digit < DIGITS; ++digit) {
            const uint own = places[pass][digit];
            places[pass][digit] = before;
            before += own;
        }
        ushort moved[BLOCK];
        for (uint k = 0u; k < count; ++k)
            moved[places[pass][keys[list[k]] >> shift & (DIGITS - 1u)]++] = list[k];
        for (uint k = 0u; k < count; ++k)
            list[k] = moved[k];
    }
}

/// One instruction each, unlike fmin and fmax, which allow NaN.
static inline float4 smaller(const float4 a, const float4 b) { return a < b ? a : b; }
static inline float4 larger(const float4 a, const float4 b) { return a > b ? a : b; }

static inline float cost_of(const float4 low, const float4 high, const float scale,
                            const uint count)
{
    const float4 sides = high - low;
    return cost_of_half(sides.x, sides.y, sides.z, scale, count);
}

/// Returns, of each list, the cost of leaves `first` to `end` - 1 as a half of a node. Fourth lanes are not used.
static inline float4 costs_of(const float4* const centres, ushort lists[3][BLOCK], const uint first,
                              const uint end, const float scale)
{
    float4 x_low = centres[lists[0][first]], y_low = centres[lists[1][first]];
    float4 z_low = centres[lists[2][first]];
    float4 x_high = x_low, y_high = y_low, z_high = z_low;
    for (uint k = first + 1u; k < end; ++k) {
        const float4 x = centres[lists[0][k]], y = centres[lists[1][k]], z = centres[lists[2][k]];
        x_low = smaller(x_low, x);
        x_high = larger(x_high, x);
        y_low = smaller(y_low, y);
        y_high = larger(y_high, y);
        z_low = smaller(z_low, z);
        z_high = larger(z_high, z);
    }
    const uint count = end - first;
    return (float4)(cost_of(x_low, x_high, scale, count), cost_of(y_low, y_high, scale, count),
                    cost_of(z_low, z_high, scale, count), 0.0f);
}

/// Moves leaves `first` to `end` - 1 of a list: those that are not `right` come first.
static inline void part_list(ushort* const list, const uchar* const right, const uint first,
                             const uint end)
{
    ushort moved[BLOCK];
    uint to_left = first, to_right = 0u;
    for (uint k = first; k < end; ++k) {
        const ushort leaf = list[k];
        list[to_left] = leaf;
        moved[to_right] = leaf;
        to_left += 1u - right[leaf];
        to_right += right[leaf];
    }
    for (uint k = 0u; k < to_right; ++k)
        list[to_left + k] = moved[k];
}

/// Splits the `count` leaves of a node, from `first` on, by cost: in each list, those that go left come first.
static inline void halve_by_cost(const float4* const centres, ushort lists[3][BLOCK],
                                 uchar* const right, const uint first, const uint count,
                                 const uint height, const float scale)
{
    const uint left = left_count(count, height);
    if (left == count)
        return;
    const uint middle = first + left, end = first + count;
    const float4 costs = costs_of(centres, lists, first, middle, scale) +
                         costs_of(centres, lists, middle, end, scale);
    const uint axis = cheapest_axis(costs.x, costs.y, costs.z);
    for (uint k = first; k < end; ++k)
        right[lists[axis][k]] = k < middle ? 0 : 1;
    for (uint list = 0u; list < 3u; ++list)
        if (list != axis)
            part_list(lists[list], right, first, end);
}

/// Puts the ids of every aligned run of 2^BLOCK_HEIGHT leaves, one run per work-item, into the order of the median splits. All splits of
/// two leaves cost nothing, so two leaves are in the order of the first axis.
kernel void halve_blocks(global const float2* restrict boxes, global uint* restrict ids,
                         const uint count)
{
    const uint start = (uint)get_global_id(0) << BLOCK_HEIGHT;
    const uint here = min(BLOCK, count - start);
    float4 centres[BLOCK];
    uint own_ids[BLOCK];
    ushort by_id[BLOCK];
    float4 low = (float4)(INFINITY), high = -low;
    for (uint k = 0u; k < here; ++k) {
        const uint id = ids[start + k];
        const Point centre = box_centre(load_box(boxes, id));
        own_ids[k] = id;
        by_id[k] = (ushort)k;
        centres[k] = (float4)(centre.x, centre.y, centre.z, 0.0f);
        low = smaller(low, centres[k]);
        high = larger(high, centres[k]);
    }
    sort_list(own_ids, by_id, here);
    ushort lists[3][BLOCK];
    for (uint axis = 0u; axis < 3u; ++axis) {
        uint keys[BLOCK];
        for (uint k = 0u; k < here; ++k) {
            keys[k] = ordered_bits(((const float*)&centres[k])[axis]);
            lists[axis][k] = by_id[k];
        }
        sort_list(keys, lists[axis], here);
    }
    const Aabb box = {low.x, low.y, low.z, high.x, high.y, high.z};
    const float scale = scale_to_one(longest_side(box, 1.0f));
    uchar right[BLOCK];
    for (uint height = BLOCK_HEIGHT; height > 1u; --height)
        for (uint first = 0u; first < here; first += 1u << height)
            halve_by_cost(centres, lists, right, first, min(1u << height, here - first), height,
                          scale);
    for (uint k = 0u; k < here; ++k)
        ids[start + k] = own_ids[lists[0][k]];
}
