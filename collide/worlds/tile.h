// SPDX-License-Identifier: MIT
//
// Tiles of boxes for the collider `all-pairs`, and which tiles of an object meet.
//
// The tiles of an object are thought of in a ring. Each meets about half of the ring, the tiles behind it, so that all have the same
// work and two tiles meet once:
//
//     ring of 4     0: 1 2     1: 2 3     2: 3     3: 0
//
// The boxes of one object in a tile meet in the same way.
#ifndef BVHBENCH_COLLIDE_TILE_H
#define BVHBENCH_COLLIDE_TILE_H

#include "geometry/dialect.h"

SHARED_BEGIN

/// Boxes `first` to `end` - 1, and the steps that a work-group takes with them: step 0 tests them against each other, step s against
/// the s-th tile behind. They are a part of the object of boxes `object_first` to `object_end` - 1, or several whole objects
/// together, which these numbers then surround. 24 bytes.
typedef struct {
    uint first, end;
    uint object_first, object_end;
    uint first_step, end_step;
} Tile;

/// Number of members of a ring of `count` that member `k` meets: those behind it.
SHARED_FN uint met_behind(uint count, uint k)
{
    return (count - 1u) / 2u + (count % 2u == 0u && k < count / 2u ? 1u : 0u);
}

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(bvhbench::Tile) == 24);
#endif
#endif
