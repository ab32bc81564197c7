// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=512u -DKEYS_PER_ITEM=4u -DCODE_WORDS=1u -DDIGIT_BITS=8u -DSTATE_EPOCH_BITS=31u
// check: -DGROUP_SIZE=32u -DKEYS_PER_ITEM=3u -DCODE_WORDS=2u -DDIGIT_BITS=8u -DSTATE_EPOCH_BITS=31u
//
// The passes of sweep.cl in one launch, for so few pairs that each group has one tile and all of them run at the same
// time. Nobody counts beforehand and nobody looks back tile by tile: each group reads what every other one says of its
// tile, all at once, which tells it what comes before and how many there are of each digit. After a pass groups wait
// until all have written their pairs, and each goes on with those that stand where its tile is.
//
// Buffers change hands within the launch: none is restrict, so that none is read by way of a cache that is not kept up.
#include "builders/stages/sort/look_back.clh"
#include "builders/stages/sort/tile_digits.clh"

// Work-items that read one digit's states, and states that each reads at once.
#define PARTS (GROUP_SIZE > DIGITS ? GROUP_SIZE / DIGITS : 1u)
#define WINDOW 8u

/// Add to totals[d] how many pairs of digit d there are, and to before[d] how many of those are in tiles before `own`.
static inline void read_tiles(local uint* const totals, local uint* const before,
                              volatile global const ulong* states, const uint own, const uint tiles,
                              const uint epoch)
{
    for (uint work = (uint)get_local_id(0); work < DIGITS * PARTS; work += GROUP_SIZE) {
        const uint digit = work % DIGITS;
        uint total = 0u, earlier = 0u;
        for (uint first = work / DIGITS; first < tiles; first += PARTS * WINDOW) {
            ulong seen[WINDOW];
#pragma unroll
            for (uint k = 0u; k < WINDOW; ++k)
                seen[k] = posted(&states[min(first + k * PARTS, tiles - 1u) * DIGITS + digit]);
#pragma unroll
            for (uint k = 0u; k < WINDOW; ++k) {
                const uint tile = first + k * PARTS;
                while (tile < tiles && (uint)(seen[k] >> STATE_EPOCH_SHIFT) != epoch)
                    seen[k] = posted(&states[tile * DIGITS + digit]);
                total += tile < tiles ? (uint)seen[k] : 0u;
                earlier += tile < own ? (uint)seen[k] : 0u;
            }
        }
        atomic_add(&totals[digit], total);
        atomic_add(&before[digit], earlier);
    }
}

/// Sort the `count` pairs of codes_a, whose ids are their positions, by `passes` digits; from a to b and back. As many
/// groups as tiles, all of which run at once. `states` has a row of digits a tile and then a word a tile; `epoch` is, and
/// so are the `passes` - 1 behind it, of no earlier pass.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void sort_at_once(
    global Code* codes_a, global uint* ids_a, global Code* codes_b, global uint* ids_b,
    volatile global ulong* states, const uint count, const uint passes, const uint epoch)
{
    local uint words[SCRATCH_WORDS] __attribute__((aligned(8)));
    local uint starts[DIGITS];  // where the digit's pairs start in the sorted tile
    local uint places
        [DIGITS];  // first the pairs of each digit, then where the digit starts in the output, minus starts[digit]
    local uint before[DIGITS];  // how many there are in tiles before
    local uint team_sums[TEAMS];
    const uint item = (uint)get_local_id(0), tile = (uint)get_group_id(0);
    const uint tiles = (uint)get_num_groups(0);
    const uint first = tile * TILE, here = min(TILE, count - first);
    for (uint pass = 0u; pass < passes; ++pass) {
        const bool is_even = pass % 2u == 0u;
        const uint shift = DIGIT_BITS * pass, now = epoch + pass;
        for (uint k = item; k < TEAMS * DIGITS; k += GROUP_SIZE)
            words[k] = 0u;
        for (OWN_DIGITS(digit))
            places[digit] = before[digit] = 0u;
        barrier(CLK_LOCAL_MEM_FENCE);
        OwnPairs own;
        load_pairs(&own, is_even ? codes_a : codes_b, is_even ? ids_a : ids_b, first, here,
                   pass == 0u);
        rank_pairs(&own, words + item / LANES * DIGITS, shift);
        barrier(CLK_LOCAL_MEM_FENCE);
        for (OWN_DIGITS(digit)) {
            starts[digit] = sum_of_teams(words, digit);
            announce(&states[tile * DIGITS + digit], now, starts[digit], false);
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        read_tiles(places, before, states, tile, tiles, now);
        scan_digits(starts, team_sums);
        scan_digits(places, team_sums);
        for (OWN_DIGITS(digit))
            places[digit] += before[digit] - starts[digit];
        barrier(CLK_LOCAL_MEM_FENCE);
        pass_on(&own, words, starts, places, is_even ? codes_b : codes_a, is_even ? ids_b : ids_a,
                here, shift);
        if (pass + 1u < passes)
            wait_for_all(states + tiles * DIGITS, tile, tiles, now);
    }
}
