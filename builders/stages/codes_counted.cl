// SPDX-License-Identifier: MIT
// check: -DAXIS_BITS=10u -DHILBERT=0 -DSTRETCHED=0 -DSEVERAL_OBJECTS=0 -DDIGIT_BITS=8u -DMOST_PASSES=8u
// check: -DAXIS_BITS=16u -DHILBERT=1 -DSTRETCHED=1 -DSEVERAL_OBJECTS=1 -DDIGIT_BITS=8u -DMOST_PASSES=8u
//
// As codes_of_all (codes.cl), and counts the digits of all codes, which the sort would otherwise do in a launch of its own that reads
// them again (sweep.cl).
#include "builders/stages/box_code.clh"
#include "builders/stages/sort/digit_counts.clh"

// Boxes that a work-item reads before it computes their codes, so that the reads overlap.
#define READ_AHEAD 2u

/// Writes the codes of all `count` boxes, of `bits` bits, and adds their digits' counts to `counters`. Begins with the last box:
/// a cache still holds the boxes that the stage `bounds` wrote last. The sort then finds the codes of the first boxes in a cache.
kernel void codes_counted(global const float2* restrict boxes,
                          global const Bounds* restrict all_bounds,
                          global const uint* restrict owners, global Code* restrict codes,
                          const uint count, const uint dropped, const uint object_shift,
                          const uint bounds_apart, volatile global uint* restrict counters,
                          const uint bits)
{
    local uint counts[MOST_PASSES * DIGITS];
    local ushort table[HILBERT_TABLE_SIZE];
    const uint passes = passes_of(bits);
    fill_hilbert_table(table);
    clear_counts(counts, passes);
    const uint stride = (uint)get_global_size(0);
    for (uint first = (uint)get_global_id(0); first < count; first += READ_AHEAD * stride) {
        Aabb own[READ_AHEAD];
#pragma unroll
        for (uint k = 0u; k < READ_AHEAD; ++k)
            own[k] = load_box(boxes, count - 1u - min(first + k * stride, count - 1u));
#pragma unroll
        for (uint k = 0u; k < READ_AHEAD; ++k) {
            if (first + k * stride < count) {
                const uint at = count - 1u - (first + k * stride);
                const Code code =
                    code_in_object(own[k], all_bounds, bounds_apart,
                                   SEVERAL_OBJECTS ? owners[at] : 0u, object_shift, dropped, table);
                codes[at] = code;
                count_code(counts, code, passes);
            }
        }
    }
    add_counts(counts, counters, passes);
}
