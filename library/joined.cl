// SPDX-License-Identifier: MIT
//
// Numbers of leaves where two trees are put side by side, and of their pairs, taken back.
#include "builders/stages/chunk.clh"
#include "collide/counters.h"
#include "geometry/dialect.h"

/// to[first + k] becomes ids[k] + first, for all k below `count`.
kernel void number_behind(global const uint* restrict ids, global uint* restrict to,
                          const uint first, const uint count)
{
    const Chunk chunk = own_chunk(count);
    for (uint k = chunk.first; k < chunk.end; ++k)
        to[first + k] = ids[k] + first;
}

/// Each pair, the second tree's leaf behind the first's, gets that leaf's own number.
kernel void own_numbers(global uint2* restrict pairs, global const uint* restrict counters,
                        const uint room, const uint first)
{
    const Chunk chunk = own_chunk(min(counters[PAIRS_COUNT], room));
    for (uint k = chunk.first; k < chunk.end; ++k)
        pairs[k].y -= first;
}
