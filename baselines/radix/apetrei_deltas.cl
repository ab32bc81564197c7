// SPDX-License-Identifier: MIT
// check: -DCODE_WORDS=1 -DSORTED_LEAVES=0
// check: -DCODE_WORDS=2 -DSORTED_LEAVES=1
#include "baselines/radix/leaves.clh"

/// common[k] becomes how much leaves k and k + 1 have in common: delta of [Apetrei2014], turned round, since
/// theirs grows with the distance.
kernel void deltas(global const Code* restrict codes, global uint* restrict common,
                   const uint leaves)
{
    const Chunk chunk = own_chunk(leaves - 1u);
    for (uint k = chunk.first; k < chunk.end; ++k)
        common[k] = common_of(codes, leaves, k, k + 1u);
}
