// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=512u -DKEYS_PER_ITEM=16u -DCODE_WORDS=1u -DDIGIT_BITS=8u -DMOST_PASSES=8u -DSTATE_EPOCH_BITS=31u
// check: -DGROUP_SIZE=32u -DKEYS_PER_ITEM=3u -DCODE_WORDS=2u -DDIGIT_BITS=8u -DMOST_PASSES=8u -DSTATE_EPOCH_BITS=31u
//
// A stable radix sort of (code, id) pairs that reads and writes each pair once a digit [Adinets2022]. One launch counts
// the digits of all passes. Then a launch a pass: a group takes the next tile of pairs, sorts it in local memory, says
// how many pairs of each digit it has, and looks back over what the tiles before it said until it knows how many
// all of them have. So groups wait for others of the same launch, which must be running already: tiles are
// handed out in the order in which groups start.
#include "builders/stages/sort/look_back.clh"
#include "builders/stages/sort/tile_digits.clh"

/// Where in `counters` what is: a row of digits a pass, how often each occurs; then how many tiles of each pass are
/// taken. All are zero before the first launch: of two such tables, which sorts take in turns, the first pass clears the
/// one that it does not use.
#define HISTOGRAM(pass) ((pass)*DIGITS)
#define TICKETS(pass) (MOST_PASSES * DIGITS + (pass))
#define COUNTERS (MOST_PASSES * (DIGITS + 1u))

/// Count the digits of all passes, which are those of `bits` bits.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void count_digits(
    global const Code* restrict codes, volatile global uint* counters, const uint count,
    const uint bits)
{
    local uint counts[MOST_PASSES * DIGITS];
    const uint passes = (bits + DIGIT_BITS - 1u) / DIGIT_BITS;
    for (uint k = (uint)get_local_id(0); k < passes * DIGITS; k += GROUP_SIZE)
        counts[k] = 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint k = (uint)get_global_id(0); k < count; k += (uint)get_global_size(0)) {
        const Code code = codes[k];
        for (uint pass = 0u; pass < passes; ++pass)
            atomic_inc(&counts[pass * DIGITS + digit_of(code, DIGIT_BITS * pass, DIGITS - 1u)]);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint k = (uint)get_local_id(0); k < passes * DIGITS; k += GROUP_SIZE)
        if (counts[k] != 0u)
            atomic_add(&counters[k], counts[k]);
}

/// The pass by digit `pass`: every pair goes to its place. `epoch` is that of no other pass since `states` was zero. On
/// the first pass ids are the pairs' own positions and `ids_in` is not read.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void sweep(
    global const Code* restrict codes_in, global const uint* restrict ids_in,
    global Code* restrict codes_out, global uint* restrict ids_out, volatile global uint* counters,
    global uint* restrict other_counters, volatile global ulong* restrict states, const uint count,
    const uint pass, const uint epoch)
{
    const uint shift = DIGIT_BITS * pass;
    // The counters of the teams make way for the tile once pairs know their places.
    local uint words[SCRATCH_WORDS] __attribute__((aligned(8)));
    local uint* const team_counts = words;
    local uint starts[DIGITS];  // where the digit's pairs start in the sorted tile
    local uint places[DIGITS];  // where the digit starts in the output, minus starts[digit]
    local uint sums[DIGITS];    // how many there are in the tile
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

    // The first tile knows what comes before: all pairs of smaller digits.
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
