// SPDX-License-Identifier: MIT
//
// Differences of points, in doubles: rounded at most once, and exact where the points are of similar magnitude.
#ifndef BVHBENCH_GEOMETRY_VECTORS_H
#define BVHBENCH_GEOMETRY_VECTORS_H

#include "geometry/triangle.h"

#if HAS_DOUBLES
SHARED_BEGIN

typedef struct {
    double x, y, z;
} Vector;

SHARED_FN_INLINED Vector difference(Point a, Point b)
{
    const Vector v = {(double)a.x - (double)b.x, (double)a.y - (double)b.y,
                      (double)a.z - (double)b.z};
    return v;
}

SHARED_FN_INLINED Vector cross_product(Vector a, Vector b)
{
    const Vector v = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    return v;
}

SHARED_FN_INLINED double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Returns the absolute value of each component.
SHARED_FN_INLINED Vector magnitude(Vector a)
{
    const Vector v = {fabs(a.x), fabs(a.y), fabs(a.z)};
    return v;
}

/// Returns the component-wise maximum. No component may be NaN.
SHARED_FN_INLINED Vector larger(Vector a, Vector b)
{
    const Vector v = {a.x < b.x ? b.x : a.x, a.y < b.y ? b.y : a.y, a.z < b.z ? b.z : a.z};
    return v;
}

/// Returns coordinate `axis` modulo 3.
SHARED_FN_INLINED float coordinate(Point p, uint axis)
{
    axis = axis % 3u;
    return axis == 0u ? p.x : (axis == 1u ? p.y : p.z);
}

SHARED_END
#endif

#endif
