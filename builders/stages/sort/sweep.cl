// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=512u -DKEYS_PER_ITEM=16u -DCODE_WORDS=1u -DDIGIT_BITS=8u -DMOST_PASSES=8u -DSTATE_EPOCH_BITS=31u
// check: -DGROUP_SIZE=32u -DKEYS_PER_ITEM=3u -DCODE_WORDS=2u -DDIGIT_BITS=8u -DMOST_PASSES=8u -DSTATE_EPOCH_BITS=31u
//
// A stable radix sort of (code, id) pairs that reads and writes each pair once per digit [Adinets2022]. One launch counts the
// digits of all passes. Then there is one launch per pass: a group takes the next tile of pairs, announces its number of pairs
// per digit, and looks back over the announcements of earlier tiles until it knows their sums. So groups wait for other groups
// of the same launch, which must be running already: tiles are handed out in the order in which groups start.
#include "builders/stages/sort/sweep_tile.clh"

// Codes that a work-item reads before it counts their digits, so that the reads overlap.
#define READ_AHEAD 8u

/// Counts the digits of all passes of codes of `bits` bits.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void count_digits(
    global const Code* restrict codes, volatile global uint* counters, const uint count,
    const uint bits)
{
    local uint counts[MOST_PASSES * DIGITS];
    const uint passes = passes_of(bits);
    clear_counts(counts, passes);
    const uint stride = (uint)get_global_size(0);
    for (uint first = (uint)get_global_id(0); first < count; first += READ_AHEAD * stride) {
        const uint here = min(READ_AHEAD, (count - first + stride - 1u) / stride);
        Code own[READ_AHEAD];
#pragma unroll
        for (uint k = 0u; k < READ_AHEAD; ++k)
            own[k] = codes[first + min(k, here - 1u) * stride];
#pragma unroll
        for (uint k = 0u; k < READ_AHEAD; ++k)
            if (k < here)
                count_code(counts, own[k], passes);
    }
    add_counts(counts, counters, passes);
}

/// Moves every pair to its place by digit `pass`. In the first pass, ids are the pairs' positions and `ids_in` is not read. `is_last`
/// tells the last pass.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void sweep(
    global const Code* restrict codes_in, global const uint* restrict ids_in,
    global Code* restrict codes_out, global uint* restrict ids_out, volatile global uint* counters,
    global uint* restrict other_counters, volatile global ulong* restrict states, const uint count,
    const uint pass, const uint epoch, const uint is_last)
{
    local Scratch scratch;
    const uint shift = DIGIT_BITS * pass;
    const uint tile = next_tile(&scratch, counters, other_counters, pass, pass == 0u);
    const uint here = min(TILE, count - tile * TILE);
    OwnCodes own;
    uint ids[KEYS_PER_ITEM], to[KEYS_PER_ITEM];
    load_codes(&own, codes_in, tile * TILE, here);
    load_ids(ids, ids_in, tile * TILE, here, pass == 0u);
    sort_tile(&own, &scratch, counters, states, tile, pass, shift, epoch, is_last != 0u);
    take_codes(&own, to, &scratch.tile, scratch.places, shift);
    write_codes(&own, to, codes_out, here);
    sort_ids(&own, ids, &scratch.tile);
    write_ids(ids, to, ids_out, here);
}
