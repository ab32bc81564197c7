// SPDX-License-Identifier: MIT
#ifndef BVHBENCH_GEOMETRY_BITS_H
#define BVHBENCH_GEOMETRY_BITS_H

#include "geometry/dialect.h"

SHARED_BEGIN

/// Returns floor(log2 x), x >= 1. Computed in integers: a float log2 is wrong from 2,097,150 on.
SHARED_FN uint floor_log2(uint x) { return 31u - clz(x); }

/// Returns ceil(log2 x), x >= 1.
SHARED_FN uint ceil_log2(uint x) { return x == 1u ? 0u : 32u - clz(x - 1u); }

/// Returns ceil(count / size) without overflow near 2^32.
SHARED_FN uint divided_up(uint count, uint size)
{
    return count / size + (count % size != 0u ? 1u : 0u);
}

SHARED_END

#endif
