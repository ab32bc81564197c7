// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=256u -DKEYS_PER_ITEM=15u -DCODE_WORDS=1u -DDIGIT_BITS=8u
// check: -DGROUP_SIZE=64u -DKEYS_PER_ITEM=3u -DCODE_WORDS=2u -DDIGIT_BITS=8u
//
// One pass of a stable radix sort of (code, id) pairs by a digit of up to eight bits. A group owns a tile of neighbouring
// pairs. Three launches per pass:
//
//     count_tiles     counts[d][t]  occurrences of digit d in tile t
//     scan_digits     counts[d][t]  occurrences in the tiles before t; totals[d]: in all tiles
//     scatter_tiles   moves each pair to its place: after smaller digits, then earlier tiles, then earlier pairs
//
// A group sorts its tile, stably, by four bits at a time. Each work-item counts the digits of its few neighbouring entries in
// 16 counters of four bits, in one register. The number of entries before a digit of a work-item is then a prefix sum over the
// group, ordered by digit, then by work-item. Two digits share a word, so the sum is over eight words per work-item:
//
//     word w of work-item i:  low half digit w, high half digit w + 8      8 * GROUP_SIZE words, w by w
//
// Every work-item adds up eight consecutive words, the group scans those sums, and every work-item expands the result over its
// eight words. No atomics; every barrier is reached by all work-items.
#include "builders/stages/code.clh"
#include "builders/stages/group_scan.clh"

#define TILE (GROUP_SIZE * KEYS_PER_ITEM)

#define COUNTER_WORDS (8u * GROUP_SIZE)

// One word in 32 is unused, so that work-items that each read eight consecutive words start in different banks.
#define PADDED(word) ((word) + (word) / 32u)

/// Local memory for the counters, in uints.
#define COUNTER_SCRATCH PADDED(COUNTER_WORDS)

/// Replaces each half word of the counters by the sum of all that precede it.
static inline void scan_counters(local uint* const counters, local uint* const scratch)
{
    const uint first = (uint)get_local_id(0) * 8u;
    uint sum = 0u;
#pragma unroll
    for (uint k = 0u; k < 8u; ++k)
        sum += counters[PADDED(first + k)];
    uint all;
    uint before = sum_before(sum, scratch, &all);
    before += all << 16u;  // digits 8 to 15 come after digits 0 to 7
#pragma unroll
    for (uint k = 0u; k < 8u; ++k) {
        const uint own = counters[PADDED(first + k)];
        counters[PADDED(first + k)] = before;
        before += own;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

/// Sorts the TILE entries of `tile` by their bits `shift` to `shift` + 3. Has a barrier before (earlier accesses to `tile` are
/// complete) and after (the result may be read). KEYS_PER_ITEM is at most 15, because counters have four bits, and odd, so that
/// work-items read their entries from different banks. TILE is below 2^16.
static inline void sort_tile(local uint* const tile, local uint* const counters,
                             local uint* const scratch, const uint shift)
{
    const uint item = (uint)get_local_id(0);
    uint entries[KEYS_PER_ITEM];
    ulong digits = 0ul;

    barrier(CLK_LOCAL_MEM_FENCE);
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k) {
        entries[k] = tile[item * KEYS_PER_ITEM + k];
        digits += 1ul << (entries[k] >> shift & 15u) * 4u;
    }
    const uint low = (uint)digits;
    const uint high = (uint)(digits >> 32u);
#pragma unroll
    for (uint w = 0u; w < 8u; ++w)
        counters[PADDED(w * GROUP_SIZE + item)] = (low >> w * 4u & 15u) | (high >> w * 4u & 15u)
                                                                              << 16u;
    barrier(CLK_LOCAL_MEM_FENCE);
    scan_counters(counters, scratch);

    digits = 0ul;
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k) {
        const uint digit = entries[k] >> shift & 15u;
        const uint earlier_ones = (uint)(digits >> digit * 4u) & 15u;
        const uint word = counters[PADDED((digit & 7u) * GROUP_SIZE + item)];
        tile[(word >> (digit >> 3u) * 16u & 0xffffu) + earlier_ones] = entries[k];
        digits += 1ul << digit * 4u;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

#define DIGITS (1u << DIGIT_BITS)
#define DIGITS_PER_ITEM (DIGITS / GROUP_SIZE)

/// Returns the number of pairs in this group's tile: TILE in all but the last.
static inline uint pairs_here(const uint count)
{
    return min(TILE, count - (uint)get_group_id(0) * TILE);
}

/// Writes counts[d][t] of this group's tile t. `mask` is the largest digit.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void count_tiles(
    global const Code* restrict codes, global uint* restrict counts, const uint count,
    const uint shift, const uint mask)
{
    local uint histogram[DIGITS];
    const uint item = (uint)get_local_id(0);
    const uint first = (uint)get_group_id(0) * TILE;
    const uint here = pairs_here(count);

    for (uint digit = item; digit < DIGITS; digit += GROUP_SIZE)
        histogram[digit] = 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint k = item; k < here; k += GROUP_SIZE)
        atomic_inc(&histogram[digit_of(codes[first + k], shift, mask)]);
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint digit = item; digit <= mask; digit += GROUP_SIZE)
        counts[digit * get_num_groups(0) + get_group_id(0)] = histogram[digit];
}

/// Computes the exclusive prefix sums of row d of `counts`, where d is this group's number, and writes the sum of the row to
/// totals[d].
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void scan_digits(
    global uint* restrict counts, global uint* restrict totals, const uint tiles)
{
    local uint scratch[SCAN_SCRATCH];
    global uint* const row = counts + get_group_id(0) * tiles;
    uint before_round = 0u;
    for (uint first = 0u; first < tiles; first += GROUP_SIZE) {
        const uint tile = first + (uint)get_local_id(0);
        const uint value = tile < tiles ? row[tile] : 0u;
        uint sum;
        const uint before = sum_before(value, scratch, &sum);
        if (tile < tiles)
            row[tile] = before_round + before;
        before_round += sum;
    }
    if (get_local_id(0) == 0)
        totals[get_group_id(0)] = before_round;
}

/// Writes to places[d] the destination of the first pair with digit d of this group's tile.
static inline void find_places(global const uint* counts, global const uint* totals,
                               const uint mask, local uint* const places, local uint* const scratch)
{
    const uint first = (uint)get_local_id(0) * DIGITS_PER_ITEM;
    uint sum = 0u;
    for (uint digit = first; digit < first + DIGITS_PER_ITEM; ++digit)
        sum += digit <= mask ? totals[digit] : 0u;
    uint all;
    uint before = sum_before(sum, scratch, &all);
    for (uint digit = first; digit < first + DIGITS_PER_ITEM; ++digit)
        if (digit <= mask) {
            places[digit] = before + counts[digit * get_num_groups(0) + get_group_id(0)];
            before += totals[digit];
        }
}

/// Moves every pair to its destination. In the first pass, ids are the pairs' positions and `ids_in` is not read.
///
/// The tile is first sorted in local memory, as entries of a digit and a position in the tile, so that the pairs of one digit
/// are written consecutively. The pairs are then read again, from memory that this group has just read.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void scatter_tiles(
    global const Code* restrict codes_in, global const uint* restrict ids_in,
    global Code* restrict codes_out, global uint* restrict ids_out,
    global const uint* restrict counts, global const uint* restrict totals, const uint count,
    const uint shift, const uint mask, const uint is_first_pass)
{
    local uint tile[TILE];
    local uint counters[COUNTER_SCRATCH];
    local uint scratch[SCAN_SCRATCH];
    local uint places[DIGITS];
    const uint item = (uint)get_local_id(0);
    const uint first = (uint)get_group_id(0) * TILE;
    const uint here = pairs_here(count);

    // Padding of the last tile has the largest digit, so it is last before and after sorting.
    for (uint k = item; k < TILE; k += GROUP_SIZE)
        tile[k] =
            k << DIGIT_BITS | (k < here ? digit_of(codes_in[first + k], shift, mask) : DIGITS - 1u);
    find_places(counts, totals, mask, places, scratch);
    // A loop instead of two calls: PoCL 3.1 crashes when it inlines the second.
    for (uint half_digit = 0u; half_digit < DIGIT_BITS; half_digit += 4u)
        sort_tile(tile, counters, scratch, half_digit);

    // The run of digit d starts at some k in the sorted tile. Afterwards places[d] + k is the destination of every pair of the
    // run.
    for (uint k = item; k < here; k += GROUP_SIZE) {
        const uint digit = tile[k] & (DIGITS - 1u);
        if (k == 0u || digit != (tile[k - 1u] & (DIGITS - 1u)))
            places[digit] -= k;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint k = item; k < here; k += GROUP_SIZE) {
        const uint from = first + (tile[k] >> DIGIT_BITS);
        const uint to = places[tile[k] & (DIGITS - 1u)] + k;
        codes_out[to] = codes_in[from];
        ids_out[to] = is_first_pass != 0u ? from : ids_in[from];
    }
}
