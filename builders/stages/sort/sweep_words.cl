// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=512u -DKEYS_PER_ITEM=16u -DCODE_WORDS=1u -DDIGIT_BITS=8u -DMOST_PASSES=8u -DSTATE_EPOCH_BITS=31u
// check: -DGROUP_SIZE=32u -DKEYS_PER_ITEM=3u -DCODE_WORDS=2u -DDIGIT_BITS=8u -DMOST_PASSES=8u -DSTATE_EPOCH_BITS=31u
//
// A pass of sweep.cl over pairs that are words of a code's size: above the id, the digits of the code that are left. In the last
// passes an id and these digits fit into one word, so a pass moves half as much.
#include "builders/stages/sort/sweep_tile.clh"

/// As `sweep`. Ids have `id_bits` bits, and above them are the digits of pass `first_pass` on. With `is_last`, only ids are written, to `ids_out`.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void sweep_words(
    global const Code* restrict words_in, global Code* restrict words_out,
    global uint* restrict ids_out, volatile global uint* counters,
    volatile global ulong* restrict states, const uint count, const uint pass, const uint epoch,
    const uint first_pass, const uint id_bits, const uint is_last)
{
    local Scratch scratch;
    const uint shift = DIGIT_BITS * (pass - first_pass) + id_bits;
    const uint tile = next_tile(&scratch, counters, pass);
    const uint here = min(TILE, count - tile * TILE);
    OwnCodes own;
    uint to[KEYS_PER_ITEM];
    load_codes(&own, words_in, tile * TILE, here);
    find_places(&own, &scratch, counters, states, tile, pass, shift, epoch, is_last != 0u);
    sort_codes(&own, to, scratch.words, scratch.starts, scratch.places, shift);
    if (is_last == 0u) {
        write_codes(&own, to, words_out, here);
        return;
    }
    uint ids[KEYS_PER_ITEM];
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k)
        ids[k] = (uint)own.codes[k] & ((1u << id_bits) - 1u);
    write_ids(ids, to, ids_out, here);
}
