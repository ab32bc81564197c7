// SPDX-License-Identifier: MIT
//
// First filter of the narrow phase, in floats: whether the plane of one triangle has the other strictly on one side.
//
// It answers yes only where rounding cannot be the cause. With u = 2^-24 and X, Y, Z the largest computed differences along each
// axis, a determinant of differences is off by at most 46 u X Y Z (derived in geometry/orient.h), if nothing overflows or
// underflows. So X, Y and Z must each be between 2^-30 and 2^40. Then six products of three factors are below 2^123. A device
// that flushes denormals errs by at most 2^-126 in a difference, a product of two and a product of three, which are compared with
// 2^-30, 2^-60 and 2^-90: at most 2^-36 of X Y Z, or u / 4096, a few times. The bound of 48 u covers both errors. Smaller or
// larger differences, and a triangle along an axis, are left to doubles.
#ifndef BVHBENCH_COLLIDE_FLOAT_FILTER_H
#define BVHBENCH_COLLIDE_FLOAT_FILTER_H

#include "geometry/triangle.h"

SHARED_BEGIN

// fmax and fmin are avoided: they treat NaN specially, which takes several instructions on CPUs. Nothing compared here is NaN
// unless a coordinate is infinite, which is out of range.
SHARED_FN_INLINED float larger_of(float a, float b) { return a < b ? b : a; }
SHARED_FN_INLINED float smaller_of(float a, float b) { return a < b ? a : b; }

SHARED_FN_INLINED float largest_of(float a, float b, float c)
{
    return larger_of(larger_of(fabs(a), fabs(b)), fabs(c));
}

/// True if the plane of a, b, c certainly has p, q, r strictly on one side.
SHARED_FN_INLINED bool plane_parts(Point a, Point b, Point c, Point p, Point q, Point r)
{
    const float ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z;
    const float vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
    const float px = p.x - a.x, py = p.y - a.y, pz = p.z - a.z;
    const float qx = q.x - a.x, qy = q.y - a.y, qz = q.z - a.z;
    const float rx = r.x - a.x, ry = r.y - a.y, rz = r.z - a.z;
    const float nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const float at_p = nx * px + ny * py + nz * pz;
    const float at_q = nx * qx + ny * qy + nz * qz;
    const float at_r = nx * rx + ny * ry + nz * rz;

    const float x = larger_of(largest_of(ux, vx, px), larger_of(fabs(qx), fabs(rx)));
    const float y = larger_of(largest_of(uy, vy, py), larger_of(fabs(qy), fabs(ry)));
    const float z = larger_of(largest_of(uz, vz, pz), larger_of(fabs(qz), fabs(rz)));
    const float bound = 0x1.8p-19f * x * y * z;
    const float low = smaller_of(smaller_of(at_p, at_q), at_r),
                high = larger_of(larger_of(at_p, at_q), at_r);
    return (low > bound || high < -bound) && smaller_of(smaller_of(x, y), z) >= 0x1p-30f &&
           larger_of(larger_of(x, y), z) <= 0x1p40f;
}

SHARED_END

#endif
