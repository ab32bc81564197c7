// SPDX-License-Identifier: MIT
#ifndef BVHBENCH_CLUSTER_HALO_TRIANGLE_H
#define BVHBENCH_CLUSTER_HALO_TRIANGLE_H

#include "geometry/triangle.h"

SHARED_BEGIN

/// A triangle of another rank, as it is sent. 40 bytes.
typedef struct {
    Aabb box;
    uint id;        ///< in the scene
    Face vertices;  ///< in the scene; any numbers where nothing reads them
} HaloTriangle;

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(bvhbench::HaloTriangle) == 40);
#endif
#endif
