// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=512u -DKEYS_PER_ITEM=10u -DCODE_WORDS=2u -DDIGIT_BITS=8u -DMOST_PASSES=8u -DSTATE_EPOCH_BITS=31u -DREADS_CODES=1 -DWRITES=1
// check: -DGROUP_SIZE=512u -DKEYS_PER_ITEM=10u -DCODE_WORDS=2u -DDIGIT_BITS=8u -DMOST_PASSES=8u -DSTATE_EPOCH_BITS=31u -DREADS_CODES=0 -DWRITES=2
// check: -DGROUP_SIZE=32u -DKEYS_PER_ITEM=3u -DCODE_WORDS=1u -DDIGIT_BITS=8u -DMOST_PASSES=8u -DSTATE_EPOCH_BITS=31u -DREADS_CODES=0 -DWRITES=0
//
// A pass of sweep.cl over pairs that are words: above the id, the digits of the code that are left. CODE_WORDS is the size of a word.
// A pair is read and written by one access, where codes and ids apart take two.
#include "builders/stages/sort/sweep_tile.clh"

// READS_CODES: words are made of codes of 32 bits, whose ids are their positions.
#if READS_CODES
typedef uint Read;
#else
typedef Code Read;
#endif

// Values of WRITES.
#define IDS 0
#define WORDS 1
#define NARROWED_WORDS 2  // words of 32 bits, without the digits that are sorted

#if WRITES == WORDS
typedef Code Written;
#else
typedef uint Written;
#endif

/// Returns what is written of a word, whose digits from bit `rest` on are still to be sorted.
static inline Written written(const Code word, const uint rest, const uint id_bits)
{
#if WRITES == WORDS
    (void)rest;
    (void)id_bits;
    return word;
#else
    const uint id = (uint)(word & (((Code)1 << id_bits) - 1u));
    return WRITES == IDS ? id : (uint)(word >> rest) << id_bits | id;
#endif
}

/// Moves every pair to its place by digit `pass`. Ids have `id_bits` bits, and above them are the digits of pass `first_pass` on.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void sweep_words(
    global const Read* restrict in, global Written* restrict out, volatile global uint* counters,
    global uint* restrict other_counters, volatile global ulong* restrict states, const uint count,
    const uint pass, const uint epoch, const uint first_pass, const uint id_bits)
{
    local Scratch scratch;
    const uint shift = DIGIT_BITS * (pass - first_pass) + id_bits;
    const uint tile = next_tile(&scratch, counters, other_counters, pass);
    const uint first = tile * TILE, here = min(TILE, count - first);
    OwnCodes own;
#if READS_CODES
    const uint start = own_start();
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k) {
        const uint at = start + k * LANES;
        own.codes[k] = at < here ? (Code)in[first + at] << id_bits | (first + at) : ~(Code)0;
    }
#else
    load_codes(&own, in, first, here);
#endif
    sort_tile(&own, &scratch, counters, states, tile, pass, shift, epoch, WRITES == IDS);
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k) {
        const uint at = k * GROUP_SIZE + (uint)get_local_id(0);
        const Code word = scratch.tile.codes[at];
        if (at < here)
            out[scratch.places[digit_of(word, shift, DIGITS - 1u)] + at] =
                written(word, shift + DIGIT_BITS, id_bits);
    }
}
