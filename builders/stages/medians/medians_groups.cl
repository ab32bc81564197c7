// SPDX-License-Identifier: MIT
// check: -DGROUP_HEIGHT=5u -DBLOCK_HEIGHT=6u
// check: -DGROUP_HEIGHT=8u -DBLOCK_HEIGHT=10u
//
// Puts every aligned block of 2^BLOCK_HEIGHT leaves into the order of exact median splits, a group per block in local memory.
// The block's leaves are slots. Three lists hold the slots sorted along each axis; they are sorted once, because splitting a
// run of a list preserves order. So the median of a run is the middle of its list. Per level, for all runs:
//
//     mark     one bit per list, leaf and other axis: whether the leaf is right of the median along that axis
//     ends     the first and last leaf of each half along the other axes: the box around its centres
//     weigh    the cost of the halves along each axis
//     move     in each list, leaves that go left before leaves that go right
//
// In runs of few leaves, reading every leaf is faster than searching for ends. Padding of the last block lies at infinity and
// is last in every list.
#include "builders/stages/medians/block_halves.clh"

/// Splits every run along its chosen axis: computes each leaf's new place in each list.
static inline void move(local ushort* const slots, local uint* const places,
                        local const uint* const marks, local const uint* const marks_before,
                        local const float* const costs, const uint height)
{
    for (uint i = 0u; i < ITEMS; ++i) {
        const uint slot = i * GROUP_SIZE + (uint)get_local_id(0);
        const uint from = places[slot];
        const uint axis = chosen_axis(costs, place_in(from, 0u), height);
        const uint x = place_after(marks, marks_before, axis, 0u, place_in(from, 0u), height);
        const uint y = place_after(marks, marks_before, axis, 1u, place_in(from, 1u), height);
        const uint z = place_after(marks, marks_before, axis, 2u, place_in(from, 2u), height);
        slots[x] = (ushort)slot;
        slots[BLOCK + y] = (ushort)slot;
        slots[2u * BLOCK + z] = (ushort)slot;
        places[slot] = x | y << 10u | z << 20u;
    }
}

/// Returns the cost of two leaves as a half of a run; 0 unless `is_real`.
static inline float cost_of_pair(const float3 a, const float3 b, const float scale,
                                 const bool is_real)
{
    const float3 low = fmin(a, b);
    const float3 high = fmax(a, b);
    return is_real ? cost_of_half(high.x - low.x, high.y - low.y, high.z - low.z, scale, 2u) : 0.0f;
}

/// Returns which of leaves 1, 2 and 3 is in the same half as leaf 0 if the four, at these places, are split.
static inline uint partner_of_first(const uint4 places)
{
    const uint before = (places.y < places.x ? 1u : 0u) + (places.z < places.x ? 1u : 0u) +
                        (places.w < places.x ? 1u : 0u);
    const uint least = min(places.y, min(places.z, places.w));
    const uint most = max(places.y, max(places.z, places.w));
    // Leaf 0 is in the first half with the smallest of the others, or in the second half with the largest.
    const uint partner = before < 2u ? least : most;
    return partner == places.y ? 1u : partner == places.z ? 2u : 3u;
}

/// Makes the last splits, of runs of four leaves, one run per work-item, and writes ids in their final order. All splits of two
/// leaves cost nothing, so two leaves are in the order of the first axis.
static inline void halve_fours(local const float* const at, local const ushort* const slots,
                               local const uint* const places, local const uint* const slot_ids,
                               global uint* ids, const uint here, const float scale)
{
    for (uint start = 4u * (uint)get_local_id(0); start < here; start += 4u * GROUP_SIZE) {
        // In the order of the first axis; padding is last.
        const uint4 four = four_slots(slots, start);
        const uint s0 = four.x, s1 = four.y, s2 = four.z, s3 = four.w;
        const float3 c0 = (float3)(at[s0], at[BLOCK + s0], at[2u * BLOCK + s0]);
        const float3 c1 = (float3)(at[s1], at[BLOCK + s1], at[2u * BLOCK + s1]);
        const float3 c2 = (float3)(at[s2], at[BLOCK + s2], at[2u * BLOCK + s2]);
        const float3 c3 = (float3)(at[s3], at[BLOCK + s3], at[2u * BLOCK + s3]);
        const uint4 there = (uint4)(places[s0], places[s1], places[s2], places[s3]);
        const uint4 y = there >> 10u & 1023u;
        const uint4 z = there >> 20u & 1023u;
        const uint with_y = partner_of_first(y);
        const uint with_z = partner_of_first(z);
        const bool all_real = start + 3u < here;
        const bool are_cut = start + 2u < here;
        const float cost_1 =
            cost_of_pair(c0, c1, scale, are_cut) + cost_of_pair(c2, c3, scale, all_real);
        const float cost_2 =
            cost_of_pair(c0, c2, scale, are_cut) + cost_of_pair(c1, c3, scale, all_real);
        const float cost_3 =
            cost_of_pair(c0, c3, scale, all_real) + cost_of_pair(c1, c2, scale, are_cut);
        const uint axis = cheapest_axis(cost_1,
                                        with_y == 1u   ? cost_1
                                        : with_y == 2u ? cost_2
                                                       : cost_3,
                                        with_z == 1u   ? cost_1
                                        : with_z == 2u ? cost_2
                                                       : cost_3);
        const uint partner = axis == 0u ? 1u : axis == 1u ? with_y : with_z;
        const uint4 along = axis == 1u ? y : z;
        const uint mate = partner == 1u ? s1 : partner == 2u ? s2 : s3;
        const uint other = partner == 1u ? s2 : s1;
        const uint last = partner == 3u ? s2 : s3;
        // Leaf 0's half is the left one if its first place is before that of the other half.
        const uint others_least = partner == 1u   ? min(along.z, along.w)
                                  : partner == 2u ? min(along.y, along.w)
                                                  : min(along.y, along.z);
        const uint own_least = min(along.x, partner == 1u   ? along.y
                                            : partner == 2u ? along.z
                                                            : along.w);
        const bool is_left = axis == 0u || own_least < others_least;
        ids[start] = slot_ids[is_left ? s0 : other];
        if (start + 1u < here)
            ids[start + 1u] = slot_ids[is_left ? mate : last];
        if (start + 2u < here)
            ids[start + 2u] = slot_ids[is_left ? other : s0];
        if (start + 3u < here)
            ids[start + 3u] = slot_ids[is_left ? last : mate];
    }
}

/// Reorders the ids of each block from any order to that of the median splits.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void order_blocks(
    global const float2* restrict boxes, global uint* restrict ids, const uint count)
{
    local float at[3u * BLOCK];                                  // centres by axis and slot
    local uint slot_ids[BLOCK];                                  // by slot
    local ushort slots[3u * BLOCK] __attribute__((aligned(8)));  // the lists: by axis and place
    local uint places[BLOCK];                                    // by slot, in all three lists
    local uint marks[6u * WORDS];                                // by row and place, one bit each
    local uint marks_before[6u * WORDS];
    local ushort ends[ENDS * (BLOCK >> SMALL_HEIGHT) / 2u];  // by end and run
    local uint ranges[RANGES];
    local uint scratch[SORT_SCRATCH];
    local float* const costs = (local float*)scratch;  // by half, axis and run; reuses scratch
    const uint start = (uint)get_group_id(0) * BLOCK;
    const uint here = min(BLOCK, count - start);

    load_block(boxes, ids + start, here, at, slot_ids);
    find_ranges(at, slot_ids, here, ranges, scratch);
    sort_block(at, slot_ids, slots, places, here, ranges, scratch);
    // Only the height is carried across the loop's barriers: PoCL 3.1 loses all other loop variables.
    for (uint height = BLOCK_HEIGHT; height > 2u; --height) {
        mark(slots, places, marks, 1u << (height - 1u));
        barrier(CLK_LOCAL_MEM_FENCE);
        if (height > SMALL_HEIGHT) {
            find_ends(slots, marks, ends, height, here);
            count_marks(marks, marks_before, height);
            barrier(CLK_LOCAL_MEM_FENCE);
        }
        weigh(at, slots, ends, costs, height, here, scale_of(ranges));
        barrier(CLK_LOCAL_MEM_FENCE);
        move(slots, places, marks, marks_before, costs, height);
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    halve_fours(at, slots, places, slot_ids, ids + start, here, scale_of(ranges));
}
