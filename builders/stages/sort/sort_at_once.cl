// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=512u -DKEYS_PER_ITEM=16u -DCODE_WORDS=1u -DDIGIT_BITS=8u -DSTATE_EPOCH_BITS=31u -DMOST_TILES=144u -DFEW_TILES=16u
// check: -DGROUP_SIZE=32u -DKEYS_PER_ITEM=3u -DCODE_WORDS=2u -DDIGIT_BITS=8u -DSTATE_EPOCH_BITS=31u -DMOST_TILES=1u -DFEW_TILES=16u
//
// The passes of sweep.cl in one launch, for so few pairs that each group has one tile and all groups are resident at the same
// time. There is no counting beforehand and no look-back tile by tile: groups sum up each other's digit counts
// (tile_sums.clh). After a pass, groups wait until all have written their pairs; each then continues with the pairs that are
// now in its tile.
//
// Buffers swap roles within the launch, so none is restrict; a restrict buffer may be read through a cache that is not
// coherent.
#include "builders/stages/sort/tile_sums.clh"

/// Sorts the `count` pairs of codes_a, whose ids are their positions, by `passes` digits, alternating between buffers a and b.
/// Launched with one group per tile, at most MOST_TILES. All groups must be resident. `states` is that of tile_sums.clh, then
/// a word per tile. No earlier pass may have used the epochs `epoch` to `epoch` + `passes` - 1.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void sort_at_once(
    global Code* codes_a, global uint* ids_a, global Code* codes_b, global uint* ids_b,
    volatile global ulong* states, const uint count, const uint passes, const uint epoch)
{
    local uint words[SCRATCH_WORDS] __attribute__((aligned(8)));
    local uint starts[DIGITS];  // start of the digit's pairs in the sorted tile
    local uint places[DIGITS];  // start of the digit in the output, minus starts[digit]
    local uint columns[COLUMN_WORDS];
    local uint team_sums[TEAMS];
    const uint item = (uint)get_local_id(0), tile = (uint)get_group_id(0);
    const uint tiles = (uint)get_num_groups(0);
    const uint first = tile * TILE, here = min(TILE, count - first);
    for (uint pass = 0u; pass < passes; ++pass) {
        const bool is_even = pass % 2u == 0u;
        const uint shift = DIGIT_BITS * pass, now = epoch + pass;
        for (uint k = item; k < TEAMS * DIGITS; k += GROUP_SIZE)
            words[k] = 0u;
        barrier(CLK_LOCAL_MEM_FENCE);
        OwnPairs own;
        load_pairs(&own, is_even ? codes_a : codes_b, is_even ? ids_a : ids_b, first, here,
                   pass == 0u);
        rank_pairs(&own, words + item / LANES * DIGITS, shift);
        barrier(CLK_LOCAL_MEM_FENCE);
        for (OWN_DIGITS(digit))
            starts[digit] = sum_of_teams(words, digit);
        announce_counts(states, starts, tile, tiles, now);
        scan_digits(starts, team_sums);
        find_places(states, places, columns, team_sums, tile, tiles, now);
        for (OWN_DIGITS(digit))
            places[digit] -= starts[digit];
        barrier(CLK_LOCAL_MEM_FENCE);
        pass_on(&own, words, starts, places, is_even ? codes_b : codes_a, is_even ? ids_b : ids_a,
                here, shift);
        if (pass + 1u < passes)
            wait_for_all(states + TILE_STATES(tiles), tile, tiles, now);
    }
}
