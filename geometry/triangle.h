// SPDX-License-Identifier: MIT
#ifndef BVHBENCH_GEOMETRY_TRIANGLE_H
#define BVHBENCH_GEOMETRY_TRIANGLE_H

#include "geometry/aabb.h"

SHARED_BEGIN

/// A vertex position. 12 bytes in C++ and in OpenCL C.
typedef struct {
    float x, y, z;
} Point;

/// A triangle of an indexed mesh: three vertex indices. 12 bytes.
typedef struct {
    uint a, b, c;
} Face;

#if BOX_FORMAT == BOX_F32
/// Returns the box of a triangle, without negative zeros.
///
/// -0 and +0 compare equal, so fmin and fmax may return either, and devices differ. Adding +0 turns -0 into +0 and changes
/// nothing else, so every box of a tree has the same bits on every device.
SHARED_FN Aabb triangle_box(Point a, Point b, Point c)
{
    Aabb box;
    box.min_x = fmin(fmin(a.x, b.x), c.x) + 0.0f;
    box.min_y = fmin(fmin(a.y, b.y), c.y) + 0.0f;
    box.min_z = fmin(fmin(a.z, b.z), c.z) + 0.0f;
    box.max_x = fmax(fmax(a.x, b.x), c.x) + 0.0f;
    box.max_y = fmax(fmax(a.y, b.y), c.y) + 0.0f;
    box.max_z = fmax(fmax(a.z, b.z), c.z) + 0.0f;
    return box;
}
#endif

/// True if two triangles share a vertex index.
SHARED_FN bool share_a_vertex(Face a, Face b)
{
    return a.a == b.a || a.a == b.b || a.a == b.c || a.b == b.a || a.b == b.b || a.b == b.c ||
           a.c == b.a || a.c == b.b || a.c == b.c;
}

SHARED_END

#ifndef __OPENCL_C_VERSION__
static_assert(sizeof(bvhbench::Point) == 12);
static_assert(sizeof(bvhbench::Face) == 12);
#endif
#endif
