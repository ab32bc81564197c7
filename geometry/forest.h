// SPDX-License-Identifier: MIT
#ifndef BVHBENCH_GEOMETRY_FOREST_H
#define BVHBENCH_GEOMETRY_FOREST_H

#include "geometry/dialect.h"

SHARED_BEGIN

/// An object's tree among those of a frame, which share their arrays. 16 bytes.
typedef struct {
    uint first;   ///< place of its first leaf in the line of all leaves
    uint leaves;  ///< at least 1
    uint nodes;   ///< without pointers: slot of its root, from which its layout counts
    uint root;    ///< with pointers: its root, as the layout refers to nodes
} ForestObject;

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(bvhbench::ForestObject) == 16);
#endif
#endif
