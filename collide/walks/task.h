// SPDX-License-Identifier: MIT
//
// Tasks that queries are split into, for host and device.
#ifndef BVHBENCH_COLLIDE_TASK_H
#define BVHBENCH_COLLIDE_TASK_H

#include "geometry/dialect.h"

// Objects that a work-item or a group tests at a time in the search for pairs of objects and for tasks between them.
#define OTHERS_AT_A_TIME 16u

// BLOCK_LEAVES: leaves of a task of `block`; BLOCK_LEVELS: levels of the subtree that they form. TEAM_LANES: lanes of a team of
// more than one work-item, which is LANES of builders/stages/sort/peers.clh.
#define BLOCK_LEVELS 5u
#define BLOCK_LEAVES (1u << BLOCK_LEVELS)
#define TEAM_LANES 32u

SHARED_BEGIN

/// Neighbouring leaves of one object to be tested against the tree of another object, or of the same. 16 bytes.
typedef struct {
    uint own;    ///< object of the leaves
    uint other;  ///< object whose tree they are tested against
    uint first;  ///< place of the first leaf
    uint count;  ///< number of leaves; 0: nothing to do
} QueryTask;

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(bvhbench::QueryTask) == 16);
#endif
#endif
