// SPDX-License-Identifier: MIT
//
// Renumbers the leaves of the second of two joined trees, and restores its own numbers in the pairs found.
#include "builders/stages/chunk.clh"
#include "collide/counters.h"
#include "geometry/dialect.h"

/// Writes ids[k] + first to to[first + k] for all k < count.
kernel void number_behind(global const uint* restrict ids, global uint* restrict to,
                          const uint first, const uint count)
{
    const Chunk chunk = own_chunk(count);
    for (uint k = chunk.first; k < chunk.end; ++k)
        to[first + k] = ids[k] + first;
}

/// Subtracts `first`, the number of leaves of the first tree, from the second number of each pair, which belongs to the second
/// tree, since pairs have the smaller number first.
kernel void own_numbers(global uint2* restrict pairs, global const uint* restrict counters,
                        const uint room, const uint first)
{
    const Chunk chunk = own_chunk(min(counters[PAIRS_COUNT], room));
    for (uint k = chunk.first; k < chunk.end; ++k)
        pairs[k].y -= first;
}
