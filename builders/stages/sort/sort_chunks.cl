// SPDX-License-Identifier: MIT
// check: -DDIGIT_BITS=8u -DCODE_WORDS=1u
// check: -DDIGIT_BITS=8u -DCODE_WORDS=2u
//
// One pass of a stable radix sort of (code, id) pairs by a digit, in a few chunks, each a work-item's own.
// Three launches a pass:
//
//     count_chunks    counts[d][c]  how often chunk c holds digit d
//     scan_chunks     counts[d][c]  where the first pair of chunk c with digit d goes
//     scatter_chunks  pairs, to their places
#include "builders/stages/chunk.clh"
#include "builders/stages/code.clh"

#define DIGITS (1u << DIGIT_BITS)

/// counts[d][c] of chunk c, this work-item's. `mask` is the largest digit there is.
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

/// Each of the `count_size` counts becomes the sum of all before it. One work-item.
kernel void scan_chunks(global uint* restrict counts, const uint count_size)
{
    uint before = 0u;
    for (uint k = 0u; k < count_size; ++k) {
        const uint own = counts[k];
        counts[k] = before;
        before += own;
    }
}

/// Move every pair to its place by the digit. On the first pass ids are the pairs' own positions and
/// `ids_in` is not read.
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
