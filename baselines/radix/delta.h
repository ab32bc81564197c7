// SPDX-License-Identifier: MIT
//
// How much two leaves have in common: delta of [Karras2012] and [Apetrei2014].
//
// A leaf's key is its code followed by its place in leaf order. So no two keys are equal, and a run of m equal
// codes becomes a balanced tree of its places instead of a ladder m levels deep. [Karras2012, Sec. 4] does so
// where codes are equal; [Apetrei2014] is silent. Both must take the same keys everywhere they compare.
//
//     key = | code, 64 bits | place, 32 bits |      shorter codes are widened: common zeros change no comparison
//
// Along the line of leaves, no two gaps next to a node are equally wide: if the node's first and last leaf
// differed from their outer neighbours in the same highest bit, that bit would be 1 and 0 inside the node.
#ifndef BVHBENCH_BASELINES_RADIX_DELTA_H
#define BVHBENCH_BASELINES_RADIX_DELTA_H

#include "geometry/bits.h"

SHARED_BEGIN

/// Bits that the keys of two different leaves share from the top, and one more: 1 to 96.
/// 0 is left for "there is no such leaf", which is farther than any.
SHARED_FN uint radix_common(ulong code_a, uint place_a, ulong code_b, uint place_b)
{
    const ulong difference = code_a ^ code_b;
    const uint high = (uint)(difference >> 32), low = (uint)difference;
    if (high != 0u)
        return 1u + clz(high);
    return low != 0u ? 33u + clz(low) : 65u + clz(place_a ^ place_b);
}

SHARED_END

#endif
