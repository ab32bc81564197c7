// SPDX-License-Identifier: MIT
//
// Which pairs of objects are tested, for host and device.
#ifndef BVHBENCH_COLLIDE_FILTER_H
#define BVHBENCH_COLLIDE_FILTER_H

#include "geometry/dialect.h"

SHARED_BEGIN

/// What one object is tested against. 16 bytes.
typedef struct {
    uint group;  ///< bits of what the object is
    uint mask;   ///< bits of what it is tested against
    uint first;  ///< place of the first object that is excluded for it, in a list of all objects'
    uint count;  ///< how many are; they ascend
} FilterRule;

/// True if each of two objects is in a group that the other is tested against.
SHARED_FN_INLINED bool masks_meet(FilterRule a, FilterRule b)
{
    return (a.group & b.mask) != 0u && (b.group & a.mask) != 0u;
}

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(bvhbench::FilterRule) == 16);
#endif
#endif
