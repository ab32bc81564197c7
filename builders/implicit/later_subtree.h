// SPDX-License-Identifier: MIT
//
// What a group of a later round of build_waiting.clh builds.
#ifndef BVHBENCH_BUILDERS_IMPLICIT_LATER_SUBTREE_H
#define BVHBENCH_BUILDERS_IMPLICIT_LATER_SUBTREE_H

#include "geometry/dialect.h"

SHARED_BEGIN

/// The `position`-th subtree of the round in an object's tree, from the roots that the round before built of it. Groups post
/// their roots by their own number; those begin at `children`.
typedef struct {
    uint children, round, position, object;
} LaterSubtree;

SHARED_END

#endif
