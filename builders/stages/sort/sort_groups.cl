// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=256u -DKEYS_PER_ITEM=15u -DCODE_WORDS=1u -DDIGIT_BITS=8u
// check: -DGROUP_SIZE=64u -DKEYS_PER_ITEM=3u -DCODE_WORDS=2u -DDIGIT_BITS=8u
//
// One pass of a stable radix sort of (code, id) pairs by a digit of up to eight bits, in groups. A group
// owns a tile of neighbouring pairs. Three launches a pass:
//
//     count_tiles     counts[d][t]  how often tile t holds digit d
//     scan_digits     counts[d][t]  how often the tiles before t do; totals[d] all tiles together
//     scatter_tiles   pairs, to where smaller digits, earlier tiles and earlier pairs end
//
// A group sorts its tile, stably, by four bits of every entry at a time. Each work-item counts the digits of its own few
// neighbouring entries in one register: 16 counters of four bits. What comes before each digit of each work-item is then a
// sum over the group, digit by digit and within a digit work-item by work-item. Two digits share a word, so it is a sum over
// eight words a work-item:
//
//     word w of work-item i:  low half digit w, high half digit w + 8      8 * GROUP_SIZE words, w by w
//
// Every work-item adds up eight of them in a row, the group scans those sums, and every work-item spreads the result over
// its eight. No atomics, and every barrier is reached by all.
#include "builders/stages/code.clh"
#include "builders/stages/group_scan.clh"

#define TILE (GROUP_SIZE * KEYS_PER_ITEM)

#define COUNTER_WORDS (8u * GROUP_SIZE)

// One word in 32 is left out, so that work-items that each read eight in a row start in different banks.
#define PADDED(word) ((word) + (word) / 32u)

/// Local memory for the counters, in uints.
#define COUNTER_SCRATCH PADDED(COUNTER_WORDS)

/// Add up the counters: each half word becomes the sum of all that comes before it.
static inline void scan_counters(local uint* const counters, local uint* const scratch)
{
    const uint first = (uint)get_local_id(0) * 8u;
    uint sum = 0u;
#pragma unroll
    for (uint k = 0u; k < 8u; ++k)
        sum += counters[PADDED(first + k)];
    uint all;
    uint before = sum_before(sum, scratch, &all);
    before += all << 16u;  // digits 8 to 15 come after all of digits 0 to 7
#pragma unroll
    for (uint k = 0u; k < 8u; ++k) {
        const uint own = counters[PADDED(first + k)];
        counters[PADDED(first + k)] = before;
        before += own;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
}

/// Sort the TILE entries of `tile` by their bits `shift` to `shift` + 3. Work done on `tile` before is
/// waited for; the result may be read after the call. KEYS_PER_ITEM is at most 15, for the counters' sake,
/// and odd, so that work-items reading their own entries read different banks. TILE is below 2^16.
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

/// Pairs in this group's tile: TILE in all but the last.
static inline uint pairs_here(const uint count)
{
    return min(TILE, count - (uint)get_group_id(0) * TILE);
}

/// counts[d][t] of tile t, this group's. `mask` is the largest digit there is.
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

/// Row d of `counts`, d this group's number, becomes the sums of what came before in the row; totals[d] the
/// sum of the row.
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

/// places[d] is afterwards where the first pair with digit d of this group's tile goes.
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

/// Move every pair to its place by the digit. On the first pass ids are the pairs' own positions and
/// `ids_in` is not read.
///
/// The tile is first sorted in local memory, as entries of a digit and the position it came from, so that
/// pairs with one digit leave as one run of neighbouring writes. The pairs are then read again, from a
/// stretch of memory this group has just read.
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

    // What fills up the last tile has the largest digit and comes last, before and after sorting.
    for (uint k = item; k < TILE; k += GROUP_SIZE)
        tile[k] =
            k << DIGIT_BITS | (k < here ? digit_of(codes_in[first + k], shift, mask) : DIGITS - 1u);
    find_places(counts, totals, mask, places, scratch);
    // A loop, not two calls: inlining the second crashes PoCL 3.1.
    for (uint half_digit = 0u; half_digit < DIGIT_BITS; half_digit += 4u)
        sort_tile(tile, counters, scratch, half_digit);

    // The run of digit d starts at some k of the sorted tile: afterwards places[d] + k is right for all of it.
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
