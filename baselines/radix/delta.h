// SPDX-License-Identifier: MIT
//
// Length of the common prefix of two leaves' keys: delta of [Karras2012] and [Apetrei2014].
//
// A leaf's key is its code followed by its place in leaf order. So no two keys are equal, and m equal codes become a balanced
// tree over their places instead of a chain m levels deep. [Karras2012, Sec. 4] does so for equal codes; [Apetrei2014] does not
// mention them. All comparisons of both algorithms must use the same keys.
//
//     key = | code, 64 bits | place, 32 bits |      shorter codes are widened: common zeros change no comparison
//
// A node's first and last leaf never share equally long prefixes with their outer neighbours. Otherwise both would first differ
// in the same bit from them. Keys ascend, so it would be 1 in the first leaf and 0 in the last, but a node's leaves share it.
#ifndef BVHBENCH_BASELINES_RADIX_DELTA_H
#define BVHBENCH_BASELINES_RADIX_DELTA_H

#include "geometry/bits.h"

SHARED_BEGIN

/// Returns one plus the number of leading bits that the keys of two different leaves share: 1 to 96. 0, less than for any leaf,
/// is reserved for "no such leaf".
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
