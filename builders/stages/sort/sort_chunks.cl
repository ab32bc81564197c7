// SPDX-License-Identifier: MIT
// check: -DDIGIT_BITS=8u -DCODE_WORDS=1u
// check: -DDIGIT_BITS=8u -DCODE_WORDS=2u
//
// One pass of a stable radix sort of (code, id) pairs by one digit, in a few chunks, one per work-item. Three launches per
// pass:
//
//     count_chunks    counts[d][c]  occurrences of digit d in chunk c
//     scan_chunks     counts[d][c]  destination of the first pair with digit d of chunk c
//     scatter_chunks  moves the pairs
#include "builders/stages/chunk.clh"
#include "builders/stages/code.clh"

#define DIGITS (1u << DIGIT_BITS)

/// Writes counts[d][c] of this work-item's chunk c. `mask` is the largest digit.
kernel void count_chunks(global const Code* restrict codes, global uint* restrict counts,
                         const uint count, const uint shift, const uint mask)
{
    uint histogram[DIGITS];
    for (uint digit = 0u; digit < DIGITS; ++digit)
        histogram[digit] = 0u;
    const Chunk chunk = own_chunk(count);
    for (uint k = chunk.first; k < chunk.end; ++k)
        ++histogram[digit_of(codes[k], shift, mask)];
    for (uint digit = 0u; digit <= mask; ++digit)
        counts[digit * get_global_size(0) + get_global_id(0)] = histogram[digit];
}

/// Computes the exclusive prefix sums of the `count_size` counts, by one work-item.
kernel void scan_chunks(global uint* restrict counts, const uint count_size)
{
    uint before = 0u;
    for (uint k = 0u; k < count_size; ++k) {
        const uint own = counts[k];
        counts[k] = before;
        before += own;
    }
}

/// Moves every pair to its destination. In the first pass, ids are the pairs' positions and `ids_in` is not read.
kernel void scatter_chunks(global const Code* restrict codes_in, global const uint* restrict ids_in,
                           global Code* restrict codes_out, global uint* restrict ids_out,
                           global const uint* restrict counts, const uint count, const uint shift,
                           const uint mask, const uint is_first_pass)
{
    uint places[DIGITS];
    for (uint digit = 0u; digit <= mask; ++digit)
        places[digit] = counts[digit * get_global_size(0) + get_global_id(0)];
    const Chunk chunk = own_chunk(count);
    for (uint k = chunk.first; k < chunk.end; ++k) {
        const Code code = codes_in[k];
        const uint to = places[digit_of(code, shift, mask)]++;
        codes_out[to] = code;
        ids_out[to] = is_first_pass != 0u ? k : ids_in[k];
    }
}
