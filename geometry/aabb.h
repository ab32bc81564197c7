// SPDX-License-Identifier: MIT
#ifndef BVHBENCH_GEOMETRY_AABB_H
#define BVHBENCH_GEOMETRY_AABB_H

#include "geometry/box_side.h"

SHARED_BEGIN

/// Axis-aligned closed box of six scalars. With float sides it has 24 bytes in C++ and in OpenCL C, where a float3 would take
/// 16 bytes. In kernels over trees, BOX_FORMAT gives the type of the sides.
typedef struct {
    BoxSide min_x, min_y, min_z;
    BoxSide max_x, max_y, max_z;
} Aabb;

/// Returns the box that contains nothing, the neutral element of `merged`.
SHARED_FN Aabb empty_box(void)
{
    const Aabb box = {MOST_SIDE, MOST_SIDE, MOST_SIDE, LEAST_SIDE, LEAST_SIDE, LEAST_SIDE};
    return box;
}

/// Returns the smallest box around `a` and `b`.
SHARED_FN Aabb merged(Aabb a, Aabb b)
{
    a.min_x = SIDE_MIN(a.min_x, b.min_x);
    a.min_y = SIDE_MIN(a.min_y, b.min_y);
    a.min_z = SIDE_MIN(a.min_z, b.min_z);
    a.max_x = SIDE_MAX(a.max_x, b.max_x);
    a.max_y = SIDE_MAX(a.max_y, b.max_y);
    a.max_z = SIDE_MAX(a.max_z, b.max_z);
    return a;
}

/// True if two closed boxes share a point. Boxes that only touch overlap.
SHARED_FN bool overlap(Aabb a, Aabb b)
{
    return a.min_x <= b.max_x && b.min_x <= a.max_x && a.min_y <= b.max_y && b.min_y <= a.max_y &&
           a.min_z <= b.max_z && b.min_z <= a.max_z;
}

#if BOX_FORMAT == BOX_F16
/// Returns the half with index `place` among all halves, in units of the smallest positive half.
SHARED_FN float half_at(BoxSide place)
{
    const uint bits = place < 0x8000 ? 0x8000u - place : place - 0x8000u;
    const uint exponent = max(bits >> 10u, 1u), mantissa = bits - ((exponent - 1u) << 10u);
    const float size = (float)mantissa * as_float((exponent + 126u) << 23u);
    return place < 0x8000 ? -size : size;
}
#define SIDE_LENGTH(low, high) (half_at(high) - half_at(low))
#else
#define SIDE_LENGTH(low, high) ((float)((high) - (low)))
#endif

/// Returns half the surface area of a box, in the unit of its sides.
SHARED_FN float half_surface(Aabb box)
{
    const float x = SIDE_LENGTH(box.min_x, box.max_x);
    const float y = SIDE_LENGTH(box.min_y, box.max_y);
    const float z = SIDE_LENGTH(box.min_z, box.max_z);
    return x * y + y * z + z * x;
}

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(bvhbench::Aabb) == 24);
#endif
#endif
