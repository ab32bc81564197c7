// SPDX-License-Identifier: MIT
#ifndef BVHBENCH_GEOMETRY_FOREST_H
#define BVHBENCH_GEOMETRY_FOREST_H

#include "geometry/dialect.h"

SHARED_BEGIN

/// The tree of one object in a frame. All trees of the frame share their arrays. 16 bytes.
typedef struct {
    uint first;   ///< position of the object's first leaf in the common order of leaves
    uint leaves;  ///< number of leaves, at least 1
    uint nodes;   ///< layouts without pointers: slot of the root, the origin of the layout's slots
    uint root;    ///< layouts with pointers: the root, as a node reference of the layout
} ForestObject;

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(bvhbench::ForestObject) == 16);
#endif
#endif
