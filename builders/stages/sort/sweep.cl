// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=512u -DKEYS_PER_ITEM=16u -DCODE_WORDS=1u -DDIGIT_BITS=8u -DMOST_PASSES=8u -DSTATE_EPOCH_BITS=31u
// check: -DGROUP_SIZE=32u -DKEYS_PER_ITEM=3u -DCODE_WORDS=2u -DDIGIT_BITS=8u -DMOST_PASSES=8u -DSTATE_EPOCH_BITS=31u
//
// A stable radix sort of (code, id) pairs that reads and writes each pair once per digit [Adinets2022]. One launch counts the
// digits of all passes. Then there is one launch per pass: a group takes the next tile of pairs, announces its number of pairs
// per digit, and looks back over the announcements of earlier tiles until it knows their sums. So groups wait for other groups
// of the same launch, which must be running already: tiles are handed out in the order in which groups start.
#include "builders/stages/sort/look_back.clh"
#include "builders/stages/sort/tile_digits.clh"

/// Layout of `counters`: a row of digit counts per pass, then the number of tiles taken in each pass. All are zero before the
/// first launch. Consecutive sorts alternate between two such tables; the first pass clears the one not in use.
#define HISTOGRAM(pass) ((pass)*DIGITS)
#define TICKETS(pass) (MOST_PASSES * DIGITS + (pass))
#define COUNTERS (MOST_PASSES * (DIGITS + 1u))

// Codes that a work-item reads before it counts their digits, so that the reads overlap.
#define READ_AHEAD 8u

/// Counts the digits of all passes of codes of `bits` bits.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void count_digits(
    global const Code* restrict codes, volatile global uint* counters, const uint count,
    const uint bits)
{
    local uint counts[MOST_PASSES * DIGITS];
    const uint passes = (bits + DIGIT_BITS - 1u) / DIGIT_BITS;
    for (uint k = (uint)get_local_id(0); k < passes * DIGITS; k += GROUP_SIZE)
        counts[k] = 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint stride = (uint)get_global_size(0);
    for (uint first = (uint)get_global_id(0); first < count; first += READ_AHEAD * stride) {
        const uint here = min(READ_AHEAD, (count - first + stride - 1u) / stride);
        Code own[READ_AHEAD];
#pragma unroll
        for (uint k = 0u; k < READ_AHEAD; ++k)
            own[k] = codes[first + min(k, here - 1u) * stride];
#pragma unroll
        for (uint k = 0u; k < READ_AHEAD; ++k)
            for (uint pass = 0u; k < here && pass < passes; ++pass)
                atomic_inc(
                    &counts[pass * DIGITS + digit_of(own[k], DIGIT_BITS * pass, DIGITS - 1u)]);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint k = (uint)get_local_id(0); k < passes * DIGITS; k += GROUP_SIZE)
        if (counts[k] != 0u)
            atomic_add(&counters[k], counts[k]);
}

/// Moves every pair to its place by digit `pass`. `epoch` must not have been used by another pass since `states` was zero. In
/// the first pass, ids are the pairs' positions and `ids_in` is not read.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void sweep(
    global const Code* restrict codes_in, global const uint* restrict ids_in,
    global Code* restrict codes_out, global uint* restrict ids_out, volatile global uint* counters,
    global uint* restrict other_counters, volatile global ulong* restrict states, const uint count,
    const uint pass, const uint epoch)
{
    const uint shift = DIGIT_BITS * pass;
    // Holds the teams' counts, then the tile, once the pairs' places are known.
    local uint words[SCRATCH_WORDS] __attribute__((aligned(8)));
    local uint* const team_counts = words;
    local uint starts[DIGITS];  // start of the digit's pairs in the sorted tile
    local uint places[DIGITS];  // start of the digit in the output, minus starts[digit]
    local uint sums[DIGITS];    // number of pairs in the tile
    local uint team_sums[TEAMS];
    local uint own_tile;
    const uint item = (uint)get_local_id(0);
    const uint team = item / LANES;

    if (pass == 0u && get_group_id(0) == 0u)
        for (uint k = item; k < COUNTERS; k += GROUP_SIZE)
            other_counters[k] = 0u;
    if (item == 0u)
        own_tile = atomic_inc(&counters[TICKETS(pass)]);
    for (uint k = item; k < TEAMS * DIGITS; k += GROUP_SIZE)
        team_counts[k] = 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint tile_number = own_tile;
    const uint first = tile_number * TILE;
    const uint here = min(TILE, count - first);

    OwnPairs own;
    load_pairs(&own, codes_in, ids_in, first, here, pass == 0u);
    rank_pairs(&own, team_counts + team * DIGITS, shift);
    barrier(CLK_LOCAL_MEM_FENCE);

    // The first tile needs no look-back: only pairs with smaller digits precede its pairs.
    if (tile_number == 0u) {
        for (OWN_DIGITS(digit))
            places[digit] = counters[HISTOGRAM(pass) + digit];
        scan_digits(places, team_sums);
    }
    for (OWN_DIGITS(digit)) {
        const uint sum = sum_of_teams(team_counts, digit);
        starts[digit] = sum;
        sums[digit] = sum;
        announce(&states[tile_number * DIGITS + digit], epoch,
                 tile_number == 0u ? places[digit] + sum : sum, tile_number == 0u);
    }
    scan_digits(starts, team_sums);
    for (OWN_DIGITS(digit)) {
        if (tile_number != 0u) {
            const uint before = look_back(states + digit, tile_number, DIGITS, epoch);
            announce(&states[tile_number * DIGITS + digit], epoch, before + sums[digit], true);
            places[digit] = before;
        }
        places[digit] -= starts[digit];
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    pass_on(&own, words, starts, places, codes_out, ids_out, here, shift);
}
