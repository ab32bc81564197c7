// SPDX-License-Identifier: MIT
//
// How queries are cut up, on both sides.
#ifndef BVHBENCH_COLLIDE_TASK_H
#define BVHBENCH_COLLIDE_TASK_H

#include "geometry/dialect.h"

// Objects that a work-item holds one against, where it looks for pairs of objects.
#define OTHERS_A_WORK_ITEM 16u

// Leaves of a task of `block`, and the levels of the subtree that they are; lanes of a team that takes one, if it has more
// than one: LANES of builders/stages/sort/peers.clh.
#define BLOCK_LEVELS 5u
#define BLOCK_LEAVES (1u << BLOCK_LEVELS)
#define TEAM_LANES 32u

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
