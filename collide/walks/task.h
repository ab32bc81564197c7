// SPDX-License-Identifier: MIT
#ifndef BVHBENCH_COLLIDE_TASK_H
#define BVHBENCH_COLLIDE_TASK_H

#include "geometry/dialect.h"

SHARED_BEGIN

/// Some neighbouring leaves of one object against the tree of another, or of the same. 16 bytes.
typedef struct {
    uint own;    ///< the object that the leaves are of
    uint other;  ///< the object whose tree they are held against
    uint first;  ///< place of the first leaf
    uint count;  ///< of leaves; 0: nothing to do
} QueryTask;

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(bvhbench::QueryTask) == 16);
#endif
#endif
