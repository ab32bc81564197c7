// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=512u -DKEYS_PER_ITEM=10u -DCODE_WORDS=2u -DDIGIT_BITS=8u -DMOST_PASSES=8u -DSTATE_EPOCH_BITS=31u -DREADS=1 -DWRITES=0 -DIF_RUNS=0
// check: -DGROUP_SIZE=512u -DKEYS_PER_ITEM=10u -DCODE_WORDS=2u -DDIGIT_BITS=8u -DMOST_PASSES=8u -DSTATE_EPOCH_BITS=31u -DREADS=0 -DWRITES=2 -DIF_RUNS=0
// check: -DGROUP_SIZE=32u -DKEYS_PER_ITEM=3u -DCODE_WORDS=1u -DDIGIT_BITS=8u -DMOST_PASSES=8u -DSTATE_EPOCH_BITS=31u -DREADS=0 -DWRITES=1 -DIF_RUNS=0
// check: -DGROUP_SIZE=32u -DKEYS_PER_ITEM=3u -DCODE_WORDS=2u -DDIGIT_BITS=8u -DMOST_PASSES=8u -DSTATE_EPOCH_BITS=31u -DREADS=2 -DWRITES=3 -DIF_RUNS=2
// check: -DGROUP_SIZE=32u -DKEYS_PER_ITEM=3u -DCODE_WORDS=2u -DDIGIT_BITS=8u -DMOST_PASSES=8u -DSTATE_EPOCH_BITS=31u -DREADS=3 -DWRITES=0 -DIF_RUNS=1
//
// A pass of sweep.cl over pairs that are words: above the id, the digits of the code that are left. CODE_WORDS is the size of a word.
// A pair is read and written by one access, where codes and ids apart take two.
//
// Codes of 64 bits do not fit beside an id. Their high parts are sorted first, then each run of equal high parts by the low parts
// (sort_runs.cl). If a run is long, all codes are sorted from the start, by the low parts and then by the high ones. A launch that is
// not needed returns.
#include "builders/stages/sort/sweep_tile.clh"

// Values of READS.
#define WORDS 0
#define CODES 1      // of 32 bits; ids are their positions
#define LOW_PARTS 2  // of codes of 64 bits; ids are their positions
#define HIGH_PARTS 3

// Values of WRITES, beside WORDS and HIGH_PARTS.
#define IDS 1
#define NARROWED_WORDS 2  // words of 32 bits, without the digits that are sorted

// Values of IF_RUNS: when the pass is needed.
#define ARE_SHORT 1
#define ARE_LONG 2

#if READS == CODES
typedef uint Read;
#else
typedef Code Read;
#endif

#if WRITES == WORDS || WRITES == HIGH_PARTS
typedef Code Written;
#else
typedef uint Written;
#endif

/// Returns the word of what is read at position `at`.
static inline Code word_of(const Read read, const uint at, const uint id_bits, const uint low_bits)
{
    if (READS == CODES)
        return (Code)read << id_bits | at;
    if (READS == LOW_PARTS)
        return ((Code)read & (((Code)1 << low_bits) - 1u)) << id_bits | at;
    return READS == HIGH_PARTS ? (Code)read >> low_bits << id_bits | at : (Code)read;
}

/// Returns what is written of a word, whose digits from bit `rest` on are still to be sorted. `codes` are all codes of 64 bits, with low
/// parts of `low_bits` bits.
static inline Written written(const Code word, const uint rest, const uint id_bits,
                              global const ulong* codes, const uint low_bits)
{
    const uint id = (uint)(word & (((Code)1 << id_bits) - 1u));
    if (WRITES == IDS)
        return id;
    if (WRITES == NARROWED_WORDS)
        return (Written)(word >> rest) << id_bits | id;
    return WRITES == HIGH_PARTS ? (Written)(codes[id] >> low_bits) << id_bits | id : (Written)word;
}

/// Moves every pair to its place by digit `pass`. Ids have `id_bits` bits, and above them are the digits of pass `first_pass` on.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void sweep_words(
    global const Read* restrict in, global Written* restrict out, volatile global uint* counters,
    global uint* restrict other_counters, volatile global ulong* restrict states, const uint count,
    const uint pass, const uint epoch, const uint first_pass, const uint id_bits,
    global const ulong* restrict codes, const uint low_bits)
{
    local Scratch scratch;
#if IF_RUNS
    if (has_long_runs(counters) != (IF_RUNS == ARE_LONG))
        return;
#endif
    const uint shift = DIGIT_BITS * (pass - first_pass) + id_bits;
    const uint tile = next_tile(&scratch, counters, other_counters, pass, READS != WORDS);
    const uint first = tile * TILE, here = min(TILE, count - first);
    OwnCodes own;
    const uint start = own_start();
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k) {
        const uint at = start + k * LANES;
        own.codes[k] =
            at < here ? word_of(in[first + at], first + at, id_bits, low_bits) : ~(Code)0;
    }
    sort_tile(&own, &scratch, counters, states, tile, pass, shift, epoch, WRITES == IDS);
#pragma unroll
    for (uint k = 0u; k < KEYS_PER_ITEM; ++k) {
        const uint at = k * GROUP_SIZE + (uint)get_local_id(0);
        const Code word = scratch.tile.codes[at];
        if (at < here)
            out[scratch.places[digit_of(word, shift, DIGITS - 1u)] + at] =
                written(word, shift + DIGIT_BITS, id_bits, codes, low_bits);
    }
}
