// SPDX-License-Identifier: MIT
//
// Side of a plane or a line on which a point lies, exact for the floats as stored.
//
//     orient3d(a, b, c, d)    sign of (a-d) . ((b-d) x (c-d)); 0: the four points are coplanar
//     orient2d(a, b, c, k)    orientation of a, b, c projected along axis k; 0: their projections are collinear
//
// As in [Shewchuk1997], the determinant is first computed in doubles, which decides unless the points are nearly coplanar. A
// difference of floats is rounded at most once. No product of three differences can overflow or underflow: the smallest float
// is 2^-149, the smallest product 2^-447, and the smallest double 2^-1074. With u = 2^-53 and X, Y, Z the largest computed
// differences along each axis, the error is at most
//
//     a difference            u X
//     a minor x y' - x' y     8 u X Y      two products of rounded factors, 3 u each; their difference, 2 u
//     the sum of three        46 u X Y Z   each 8 + 2 for z + 2 for the product; two sums, 4 u and 6 u
//
// up to terms of order u^2, which 48 u covers. In the plane the bound is 8 u X Y; 9 u covers it.
//
// If that does not decide, one of two exact sums does. If all coordinates along an axis are multiples of some g and the
// differences are less than 2^26 g, as in most doubtful cases, all differences and minors are exact doubles, and a product of
// three is the sum of two doubles: 6 terms. Otherwise the determinant is a sum of products of coordinates, not of differences:
// the product of two floats is exact in a double, and its upper and its lower half each have an exact product with a third
// float, so the 24 products of the determinant become 48 terms. The terms and all their sums are multiples of 2^-447 below
// 2^390, so nothing overflows or underflows.
#ifndef BVHBENCH_GEOMETRY_ORIENT_H
#define BVHBENCH_GEOMETRY_ORIENT_H

#include "geometry/exact_sum.h"
#include "geometry/vectors.h"

#if HAS_DOUBLES
SHARED_BEGIN

#define UNSURE 2

/// Returns the sign of a number whose error is at most `bound`, or UNSURE.
SHARED_FN int sign_beyond(double value, double bound)
{
    return value > bound ? 1 : (value < -bound ? -1 : UNSURE);
}

/// Returns the error bound of a determinant of differences; `most` holds the largest difference along each axis.
SHARED_FN double orient3d_bound(Vector most) { return 0x1.8p-48 * most.x * most.y * most.z; }

/// Returns the upper half of a double's bits; the rest has no more bits than that (Veltkamp's splitting).
SHARED_FN double upper_half(double x)
{
    const double spread = 134217729.0 * x;  // 2^27 + 1
    return spread - (spread - x);
}

/// True if x is a multiple of some g such that `most`, the largest difference along the axis of x, is below 2^26 g. Tests
/// whether x survives the addition to L = 2^28 `most`. Floats that are 2^26 times as large as their differences have no
/// differences, so |x| is below L / 4. The sum is therefore rounded to a multiple of at least half the last bit of L, which is
/// at least 2^-54 L, or 2^-26 `most`.
SHARED_FN bool is_regular(float x, double most)
{
    const double large = 0x1p28 * most;
    return ((double)x + large) - large == (double)x;
}

SHARED_FN bool is_point_regular(Point p, Vector most)
{
    return is_regular(p.x, most.x) && is_regular(p.y, most.y) && is_regular(p.z, most.z);
}

/// Returns the exact sign of u . n. The coordinates from which u and the factors of n were computed must be regular.
SHARED_FN int sign_of_regular(Vector u, Vector n)
{
    const double x = upper_half(n.x), y = upper_half(n.y), z = upper_half(n.z);
    const Terms terms = {
        {u.x * x, u.y * y, u.z * z, u.x * (n.x - x), u.y * (n.y - y), u.z * (n.z - z)}};
    return sign_of_sum(terms, 6u);
}

/// orient3d of arbitrary floats by the sum of 48 terms alone: - [b c d] + [a c d] - [a b d] + [a b c].
SHARED_FN int orient3d_of_products(Point a, Point b, Point c, Point d)
{
    Terms terms = {{0.0}};
    for (uint without = 0u; without < 4u; ++without) {
        const Point p = without == 0u ? b : a;
        const Point q = without <= 1u ? c : b;
        const Point r = without <= 2u ? d : c;
        const double sign = without % 2u == 0u ? -1.0 : 1.0;
        const double minors[6] = {(double)q.y * (double)r.z, -((double)q.z * (double)r.y),
                                  (double)q.z * (double)r.x, -((double)q.x * (double)r.z),
                                  (double)q.x * (double)r.y, -((double)q.y * (double)r.x)};
        for (uint k = 0u; k < 6u; ++k) {
            const double factor = sign * (double)coordinate(p, k / 2u);
            const double upper = upper_half(minors[k]);
            terms.at[12u * without + 2u * k] = upper * factor;
            terms.at[12u * without + 2u * k + 1u] = (minors[k] - upper) * factor;
        }
    }
    return sign_of_sum(terms, 48u);
}

SHARED_FN int orient3d(Point a, Point b, Point c, Point d)
{
    const Vector u = difference(a, d), v = difference(b, d), w = difference(c, d);
    const Vector normal = cross_product(v, w);
    const Vector most = larger(larger(magnitude(u), magnitude(v)), magnitude(w));
    const double bound = orient3d_bound(most);
    const int sign = sign_beyond(dot(u, normal), bound);
    if (sign != UNSURE)
        return sign;
    if (bound == 0.0)  // all points are equal along some axis
        return 0;
    if (is_point_regular(a, most) && is_point_regular(b, most) && is_point_regular(c, most) &&
        is_point_regular(d, most))
        return sign_of_regular(u, normal);
    return orient3d_of_products(a, b, c, d);
}

SHARED_FN int orient2d(Point a, Point b, Point c, uint axis)
{
    const double ax = (double)coordinate(a, axis + 1u), ay = (double)coordinate(a, axis + 2u);
    const double bx = (double)coordinate(b, axis + 1u), by = (double)coordinate(b, axis + 2u);
    const double cx = (double)coordinate(c, axis + 1u), cy = (double)coordinate(c, axis + 2u);
    const double ux = ax - cx, uy = ay - cy, vx = bx - cx, vy = by - cy;
    const double bound = 0x1.2p-50 * fmax(fabs(ux), fabs(vx)) * fmax(fabs(uy), fabs(vy));
    const int sign = sign_beyond(ux * vy - uy * vx, bound);
    if (sign != UNSURE)
        return sign;
    if (bound == 0.0)
        return 0;
    const Terms terms = {{ax * by, -(ay * bx), bx * cy, -(by * cx), cx * ay, -(cy * ax)}};
    return sign_of_sum(terms, 6u);
}

SHARED_END
#endif

#endif
