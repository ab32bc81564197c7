// SPDX-License-Identifier: MIT
//
// Wide nodes above the small subtrees of a tree, for host and device; collapse.cl and collapse_implicit.cl make them.
#ifndef BVHBENCH_COLLIDE_WIDE_NODE_H
#define BVHBENCH_COLLIDE_WIDE_NODE_H

#include "collide/walks/task.h"
#include "geometry/aabb.h"
#include "geometry/bits.h"

// A subtree of class 0 has at most BLOCK_LEAVES leaves; one of class k at most WIDE_FAN^k times as many, and more than a subtree of
// class k - 1.
#define WIDE_FAN_BITS 4u

// Bit of WideChild::count: what follows are leaves.
#define OF_LEAVES 0x80000000u

SHARED_BEGIN

/// A child of a wide node. 32 bytes, which two aligned loads of 16 bytes read.
typedef struct {
    Aabb box;
    uint first;  ///< of a small subtree, its first leaf; else the number of its first child
    uint count;  ///< of its leaves, with OF_LEAVES, or of its children
} WideChild;

/// Returns the class of a subtree with this many leaves.
SHARED_FN uint wide_class(uint leaves)
{
    return leaves <= BLOCK_LEAVES ? 0u
                                  : divided_up(ceil_log2(leaves) - BLOCK_LEVELS, WIDE_FAN_BITS);
}

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(bvhbench::WideChild) == 32);
#endif
#endif
