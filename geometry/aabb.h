// SPDX-License-Identifier: MIT
#ifndef BVHBENCH_GEOMETRY_AABB_H
#define BVHBENCH_GEOMETRY_AABB_H

#include "geometry/dialect.h"

SHARED_BEGIN

/// Axis-aligned box, closed on all sides. 24 bytes on both sides: no float3, whose size is 16 in OpenCL C.
typedef struct {
    float min_x, min_y, min_z;
    float max_x, max_y, max_z;
} Aabb;

/// The box that contains nothing: the neutral element of `merged`.
SHARED_FN Aabb empty_box(void)
{
    const float big = 3.402823466e+38f;
    const Aabb box = {big, big, big, -big, -big, -big};
    return box;
}

/// The smallest box around two boxes.
SHARED_FN Aabb merged(Aabb a, Aabb b)
{
    a.min_x = fmin(a.min_x, b.min_x);
    a.min_y = fmin(a.min_y, b.min_y);
    a.min_z = fmin(a.min_z, b.min_z);
    a.max_x = fmax(a.max_x, b.max_x);
    a.max_y = fmax(a.max_y, b.max_y);
    a.max_z = fmax(a.max_z, b.max_z);
    return a;
}

/// Whether two closed boxes share a point: touching counts.
SHARED_FN bool overlap(Aabb a, Aabb b)
{
    return a.min_x <= b.max_x && b.min_x <= a.max_x && a.min_y <= b.max_y && b.min_y <= a.max_y &&
           a.min_z <= b.max_z && b.min_z <= a.max_z;
}

/// Half the surface of a box.
SHARED_FN float half_surface(Aabb box)
{
    const float x = box.max_x - box.min_x, y = box.max_y - box.min_y, z = box.max_z - box.min_z;
    return x * y + y * z + z * x;
}

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(bvhbench::Aabb) == 24);
#endif
#endif
