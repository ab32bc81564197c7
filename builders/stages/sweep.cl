// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=512u -DKEYS_PER_ITEM=16u -DCODE_WORDS=1u
// check: -DGROUP_SIZE=32u -DKEYS_PER_ITEM=3u -DCODE_WORDS=2u
//
// A stable radix sort of (code, id) pairs that reads and writes each pair once a digit [Adinets2022]. One launch counts
// the digits of all passes. Then a launch a pass: a group takes the next tile of pairs, sorts it in local memory, says
// how many pairs of each digit it has, and looks back over what the tiles before it said until it knows how many
// all of them have. So groups wait for others of the same launch, which must be running already: tiles are
// handed out in the order in which groups start.
//
// All of them do nothing where is_idle() says so, but that counters are cleared.
//
// Pairs are ranked by teams of LANES work-items that vote: on NVIDIA's GPUs a warp; elsewhere, in tests, each
// by itself.
#include "builders/stages/code.clh"
#include "builders/stages/idle.clh"
#include "builders/stages/look_back.clh"
#include "builders/stages/peers.clh"

#define DIGITS 256u
#define DIGITS_PER_ITEM ((DIGITS + GROUP_SIZE - 1u) / GROUP_SIZE)
#define TEAMS (GROUP_SIZE / LANES)
#define TILE (GROUP_SIZE * KEYS_PER_ITEM)
#define MOST_PASSES 8u
#define SCRATCH_WORDS                                                                           \
    (CODE_WORDS * TILE > TEAMS * DIGITS ? CODE_WORDS * TILE : TEAMS * DIGITS)

/// Of this work-item's digits, the first; they end before the smaller of it plus DIGITS_PER_ITEM and DIGITS.
#define OWN_DIGITS(digit)                                                                       \
    uint digit = min((uint)get_local_id(0) * DIGITS_PER_ITEM, DIGITS);                          \
    digit < min(((uint)get_local_id(0) + 1u) * DIGITS_PER_ITEM, DIGITS);                        \
    ++digit

/// Where in `counters` what is: a row of digits a pass, how often each occurs; then how many tiles of each pass are
/// taken. All are zero before the first launch: of two such tables, which sorts take in turns, the first pass clears the
/// one that it does not use.
#define HISTOGRAM(pass) ((pass) * DIGITS)
#define TICKETS(pass) (MOST_PASSES * DIGITS + (pass))
#define COUNTERS (MOST_PASSES * (DIGITS + 1u))

/// Count the digits of all passes, which are those of `bits` bits.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void count_digits(
    global const Code* restrict codes, volatile global uint* counters, const uint count,
    const uint bits, global const uint* unsorted, const uint build)
{
    local uint counts[MOST_PASSES * DIGITS];
    if (is_idle(unsorted, build))
        return;
    const uint passes = (bits + 7u) / 8u;
    for (uint k = (uint)get_local_id(0); k < passes * DIGITS; k += GROUP_SIZE)
        counts[k] = 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint k = (uint)get_global_id(0); k < count; k += (uint)get_global_size(0)) {
        const Code code = codes[k];
        for (uint pass = 0u; pass < passes; ++pass)
            atomic_inc(&counts[pass * DIGITS + digit_of(code, 8u * pass, DIGITS - 1u)]);
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    for (uint k = (uint)get_local_id(0); k < passes * DIGITS; k += GROUP_SIZE)
        if (counts[k] != 0u)
            atomic_add(&counters[k], counts[k]);
}

/// values[d], one a digit, becomes the sum of those of smaller digits. What was written to them before is waited for;
/// the sums may be read after a barrier.
static inline void scan_digits(local uint* const values, local uint* const team_sums)
{
    uint own = 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    for (OWN_DIGITS(digit))
        own += values[digit];
    const uint team = (uint)get_local_id(0) / LANES;
    const uint up_to_own = sum_in_team(own);
    if ((uint)get_local_id(0) % LANES == LANES - 1u)
        team_sums[team] = up_to_own;
    barrier(CLK_LOCAL_MEM_FENCE);
    uint before = up_to_own - own;
    for (uint t = 0u; t < team; ++t)
        before += team_sums[t];
    for (OWN_DIGITS(digit)) {
        const uint value = values[digit];
        values[digit] = before;
        before += value;
    }
}

/// The pass by digit `pass`: every pair goes to its place. `epoch` is that of no other pass since `states` was zero. On
/// the first pass ids are the pairs' own positions and `ids_in` is not read.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void sweep(
    global const Code* restrict codes_in, global const uint* restrict ids_in,
    global Code* restrict codes_out, global uint* restrict ids_out,
    volatile global uint* counters, global uint* restrict other_counters,
    volatile global ulong* restrict states, const uint count, const uint pass, const uint epoch,
    global const uint* unsorted, const uint build)
{
    const uint shift = 8u * pass;
    // The counters of the teams make way for the tile once pairs know their places.
    local uint words[SCRATCH_WORDS] __attribute__((aligned(8)));
    local uint* const team_counts = words;
    local Code* const tile = (local Code*)words;
    local uint starts[DIGITS];  // where the digit's pairs start in the sorted tile
    local uint places[DIGITS];  // where those of the tile go, less that
    local uint sums[DIGITS];    // how many there are in the tile
    local uint team_sums[TEAMS];
    local uint own_tile;
    const uint item = (uint)get_local_id(0);
    const uint team = item / LANES, lane = item % LANES;

    if (pass == 0u && get_group_id(0) == 0u)
        for (uint k = item; k < COUNTERS; k += GROUP_SIZE)
            other_counters[k] = 0u;
    if (is_idle(unsorted, build))
        return;
    if (item == 0u)
        own_tile = atomic_inc(&counters[TICKETS(pass)]);
    for (uint k = item; k < TEAMS * DIGITS; k += GROUP_SIZE)
        team_counts[k] = 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint tile_number = own_tile;
    const uint first = tile_number * TILE;
    const uint here = min(TILE, count - first);

    // A team's pairs are neighbours, and a work-item's are LANES apart: in the order of k, then of lanes, they are in
    // order. What fills up the last tile has the largest digit and comes last.
    Code codes[KEYS_PER_ITEM];
    uint ids[KEYS_PER_ITEM], ranks[KEYS_PER_ITEM];
    const uint start = team * LANES * KEYS_PER_ITEM + lane;
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k) {
        const uint at = start + k * LANES;
        codes[k] = at < here ? codes_in[first + at] : ~(Code)0;
    }
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k) {
        const uint at = start + k * LANES;
        ids[k] = pass == 0u ? first + at : at < here ? ids_in[first + at] : 0u;
    }
    uint peers[KEYS_PER_ITEM];
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k)
        peers[k] = peers_of(digit_of(codes[k], shift, DIGITS - 1u));
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k)
        ranks[k] = counted_before(&team_counts[team * DIGITS],
                                  digit_of(codes[k], shift, DIGITS - 1u), peers[k]);
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k)
        ranks[k] = rank_of(peers[k], ranks[k]);
    barrier(CLK_LOCAL_MEM_FENCE);

    // The first tile knows what comes before: all pairs of smaller digits.
    if (tile_number == 0u) {
        for (OWN_DIGITS(digit))
            places[digit] = counters[HISTOGRAM(pass) + digit];
        scan_digits(places, team_sums);
    }
    for (OWN_DIGITS(digit)) {
        uint sum = 0u;
#pragma unroll
        for (uint t = 0u; t < TEAMS; ++t) {
            const uint own = team_counts[t * DIGITS + digit];
            team_counts[t * DIGITS + digit] = sum;
            sum += own;
        }
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
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k) {
        const uint digit = digit_of(codes[k], shift, DIGITS - 1u);
        ranks[k] += starts[digit] + team_counts[team * DIGITS + digit];
    }
    barrier(CLK_LOCAL_MEM_FENCE);

    // Pairs with one digit leave as one run of neighbouring writes: first the codes, then the ids by the same way.
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k)
        tile[ranks[k]] = codes[k];
    barrier(CLK_LOCAL_MEM_FENCE);
    uint to[KEYS_PER_ITEM];
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k) {
        const uint at = k * GROUP_SIZE + item;
        to[k] = places[digit_of(tile[at], shift, DIGITS - 1u)] + at;
        if (at < here)
            codes_out[to[k]] = tile[at];
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    local uint* const tile_ids = words;
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k)
        tile_ids[ranks[k]] = ids[k];
    barrier(CLK_LOCAL_MEM_FENCE);
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k) {
        const uint at = k * GROUP_SIZE + item;
        if (at < here)
            ids_out[to[k]] = tile_ids[at];
    }
}
