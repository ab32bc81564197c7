// SPDX-License-Identifier: MIT
//
// Input of a group of a later round of build_waiting.clh.
#ifndef BVHBENCH_BUILDERS_IMPLICIT_LATER_SUBTREE_H
#define BVHBENCH_BUILDERS_IMPLICIT_LATER_SUBTREE_H

#include "geometry/dialect.h"

SHARED_BEGIN

/// The `position`-th subtree of round `round` in an object's tree, built over subtree roots of the previous round. Groups post
/// their roots by group number; the roots of the object's previous round begin at index `children`.
typedef struct {
    uint children, round, position, object;
} LaterSubtree;

SHARED_END

#endif
