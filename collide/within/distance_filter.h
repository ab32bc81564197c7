// SPDX-License-Identifier: MIT
//
// Whether two triangles are within a distance of each other, decided in floats or doubles where rounding cannot be the cause of the answer.
//
// Two certificates decide, however the points were found that they are about. Any point of one and any of the other are at least as far
// apart as the triangles. And if n . (b - a) is at least g for all corners a and b, then so it is for all points, which are at least
// g / |n| apart, whatever the vector n is. For n, from the nearest point to the nearest, both are the distance. That way is the shortest
// of those between two edges, nine pairs, and from a corner to its foot inside the other face, six.
//
// With u = 2^-53 (of floats 2^-24), all corners as differences from the first, at most M along each axis, and N the sum of the sizes of n's
// coordinates:
//
//     a corner            u M      a difference of floats
//     a side, a start     4 u M    a difference of two corners, at most 2 M
//     a coordinate of n   28 u M   a start and two sides with shares of at most 1; three sums; a foot off its face by u: 64 u M covers it
//     n . b - n . a       12 u M N two products of three terms, 4 u M N each; two differences, 2 u M N each: 16 u M N covers it
//
// So the square of the distance is at most n . n + 4 * 64 u M (N + 64 u M), and n . (b - a) at least what is computed less 16 u M N, up
// to factors of squares and sums, and of the square that they are compared with: 1 + 10 u in all, which 1 + 16 u covers.
//
// In doubles M is 0 or at least 2^-149, as floats are multiples of that: with N of at least 2^-400, what underflows is less than the smallest
// part of a bound. Sums of squares are below 2^524. A device may take a denormal float for 0, so within.cl leaves pairs with one to the host.
// In floats M must be from 2^-40 to 2^30. What underflows or is flushed, also of corners, is less than 2^-126, some ten times, and 64 u M
// squared at least 2^-116. For a direction N must be at least 2^-40: u M N is at least 2^-104 and the square of n 2^-82. Products are below
// 2^128, with n's largest coordinate at most 2 M. Of products that are compared, flushing keeps the order.
//
//     REAL_BITS    32 or 64: precision of the type Real; 64 if it is not defined
#ifndef BVHBENCH_COLLIDE_DISTANCE_FILTER_H
#define BVHBENCH_COLLIDE_DISTANCE_FILTER_H

#include "collide/narrow/double_filter.h"

#ifndef REAL_BITS
#define REAL_BITS 64
#endif

#if HAS_DOUBLES
SHARED_BEGIN

// DISTANCE_UNIT: u. SHORTEST_SUM: the least N.
#if REAL_BITS == 64
#define DISTANCE_UNIT 0x1p-53
#define SHORTEST_SUM 0x1p-400
typedef double Real;
typedef Vector Arrow;
#else
#define DISTANCE_UNIT 0x1p-24f
#define SHORTEST_SUM 0x1p-40f
typedef float Real;
typedef struct {
    float x, y, z;
} Arrow;
#endif

/// Corners of two triangles as differences from one point, and the largest of their coordinates.
typedef struct {
    Arrow a[3], b[3];
    Real size;
} Spread;

/// The way from a point of one triangle to a point of the other, and the square of its length.
typedef struct {
    Arrow along;
    Real square;
} Way;

/// True if a corner of one is where one of the other is, by bits: == may take two denormals for each other.
SHARED_FN_INLINED bool have_common_corner(Corners p, Corners q)
{
    bool is_found = false;
    for (uint k = 0u; k < 9u; ++k) {
        const Point a = p.at[k / 3u], b = q.at[k % 3u];
        is_found = is_found || (as_uint(a.x) == as_uint(b.x) && as_uint(a.y) == as_uint(b.y) &&
                                as_uint(a.z) == as_uint(b.z));
    }
    return is_found;
}

/// True if a coordinate is a denormal, which a device may take for 0.
SHARED_FN_INLINED bool has_denormal(Corners p)
{
    bool is_found = false;
    for (uint k = 0u; k < 9u; ++k) {
        const uint bits = as_uint(coordinate(p.at[k / 3u], k)) << 1;
        is_found = is_found || (bits != 0u && bits < 0x01000000u);
    }
    return is_found;
}

SHARED_FN_INLINED Arrow arrow(Point from, Point to)
{
    const Arrow v = {(Real)to.x - (Real)from.x, (Real)to.y - (Real)from.y,
                     (Real)to.z - (Real)from.z};
    return v;
}

SHARED_FN_INLINED Arrow less(Arrow a, Arrow b)
{
    const Arrow v = {a.x - b.x, a.y - b.y, a.z - b.z};
    return v;
}

/// Returns a - s b.
SHARED_FN_INLINED Arrow less_share(Arrow a, Real s, Arrow b)
{
    const Arrow v = {a.x - s * b.x, a.y - s * b.y, a.z - s * b.z};
    return v;
}

SHARED_FN_INLINED Real product(Arrow a, Arrow b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

SHARED_FN_INLINED Arrow normal_of(Arrow a, Arrow b)
{
    const Arrow v = {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
    return v;
}

SHARED_FN_INLINED Real share_of(Real s) { return s < 0 ? (Real)0 : (s > 1 ? (Real)1 : s); }

SHARED_FN_INLINED Real largest(Arrow a) { return fmax(fmax(fabs(a.x), fabs(a.y)), fabs(a.z)); }

SHARED_FN_INLINED Way shorter(Way a, Arrow along)
{
    const Way b = {along, product(along, along)};
    return b.square < a.square ? b : a;
}

/// Returns the shortest way from the edge with side u to the one with side v, which starts at w from the start of the first.
SHARED_FN_INLINED Arrow way_between(Arrow w, Arrow u, Arrow v)
{
    const Real uu = product(u, u), uv = product(u, v), vv = product(v, v);
    const Real uw = product(u, w), vw = product(v, w);
    const Real area = uu * vv - uv * uv;
    const Real near = area > 0 ? share_of((uw * vv - uv * vw) / area) : (Real)0;
    const Real t = vv > 0 ? share_of((uv * near - vw) / vv) : (Real)0;
    const Real s = uu > 0 ? share_of((uw + uv * t) / uu) : (Real)0;
    return less_share(less_share(w, s, u), -t, v);
}

/// Returns the way to w from its foot in the plane of the sides u and v; if that is outside of the triangle, from a corner.
SHARED_FN_INLINED Arrow way_over(Arrow w, Arrow u, Arrow v)
{
    const Arrow normal = normal_of(u, v);
    const Real square = product(normal, normal);
    const Real s = square > 0 ? product(normal_of(w, v), normal) / square : (Real)-1;
    const Real t = square > 0 ? product(normal_of(u, w), normal) / square : (Real)-1;
    const bool is_inside = s >= 0 && t >= 0 && s + t <= 1;
    return is_inside ? less_share(less_share(w, s, u), t, v) : w;
}

SHARED_FN_INLINED Spread spread_of(Corners p, Corners q)
{
    const Point from = p.at[0];
    Spread spread = {{arrow(from, from), arrow(from, p.at[1]), arrow(from, p.at[2])},
                     {arrow(from, q.at[0]), arrow(from, q.at[1]), arrow(from, q.at[2])},
                     0};
    for (uint k = 0u; k < 3u; ++k)
        spread.size = fmax(spread.size, fmax(largest(spread.a[k]), largest(spread.b[k])));
    return spread;
}

/// Returns the shortest way between two corners.
SHARED_FN_INLINED Way way_between_corners(Spread of)
{
    Way best = {less(of.b[0], of.a[0]), 0};
    best.square = product(best.along, best.along);
    for (uint k = 1u; k < 9u; ++k)
        best = shorter(best, less(of.b[k % 3u], of.a[k / 3u]));
    return best;
}

/// Returns the shortest way between two triangles that do not meet, but for rounding; `best` is that between their corners.
SHARED_FN Way shortest_way(Spread of, Way best)
{
    for (uint k = 0u; k < 9u; ++k) {
        const uint i = k / 3u, j = k % 3u;
        best = shorter(best, way_between(less(of.b[j], of.a[i]), less(of.a[(i + 1u) % 3u], of.a[i]),
                                         less(of.b[(j + 1u) % 3u], of.b[j])));
    }
    for (uint k = 0u; k < 3u; ++k) {
        best = shorter(
            best, way_over(less(of.b[k], of.a[0]), less(of.a[1], of.a[0]), less(of.a[2], of.a[0])));
        const Arrow back =
            way_over(less(of.a[k], of.b[0]), less(of.b[1], of.b[0]), less(of.b[2], of.b[0]));
        const Arrow along = {-back.x, -back.y, -back.z};
        best = shorter(best, along);
    }
    return best;
}

/// Returns the least n . (b - a) of all corners, as computed.
SHARED_FN_INLINED Real gap_along(Arrow n, Spread of)
{
    return fmin(fmin(product(n, of.b[0]), product(n, of.b[1])), product(n, of.b[2])) -
           fmax(fmax(product(n, of.a[0]), product(n, of.a[1])), product(n, of.a[2]));
}

SHARED_FN_INLINED bool is_in_range(Spread of)
{
    return REAL_BITS == 64 || (of.size >= (Real)0x1p-40 && of.size <= (Real)0x1p30);
}

/// True if `n` certainly shows that two triangles are farther apart than the distance, whose square is at most `high`.
SHARED_FN_INLINED bool parts(Arrow n, Spread of, Real high)
{
    const Real sum = fabs(n.x) + fabs(n.y) + fabs(n.z), part = 16 * DISTANCE_UNIT;
    const Real gap = gap_along(n, of) - part * of.size * sum;
    return sum >= SHORTEST_SUM && gap > 0 &&
           gap * gap * (1 - part) > high * (product(n, n) * (1 + part)) && is_in_range(of);
}

/// What a way certainly shows of two triangles; else VERDICT_UNSURE. The square of the distance is between `low` and `high`.
SHARED_FN_INLINED uint shown_by(Way way, Spread of, Real low, Real high)
{
    const Arrow n = way.along;
    const Real sum = fabs(n.x) + fabs(n.y) + fabs(n.z), slack = 64 * DISTANCE_UNIT * of.size;
    const Real most = way.square + 4 * slack * (sum + slack);
    if (most * (1 + 16 * DISTANCE_UNIT) <= low && is_in_range(of))
        return VERDICT_MEET;
    return parts(n, of, high) ? VERDICT_APART : VERDICT_UNSURE;
}

/// Returns a vector across the plane of the sides u and v, in which w starts, to the side of w; its largest coordinate is 1.
SHARED_FN_INLINED Arrow across(Arrow u, Arrow v, Arrow w)
{
    const Arrow normal = normal_of(u, v), none = {0, 0, 0};
    const Real size = largest(normal), to = product(normal, w) < 0 ? -size : size;
    return less_share(none, -1 / to, normal);
}

/// True if the plane of one of two triangles certainly shows that they are farther apart than the distance.
SHARED_FN_INLINED bool planes_part(Spread of, Real high)
{
    const Arrow* a = of.a;
    const Arrow* b = of.b;
    const Arrow from_a = across(less(a[1], a[0]), less(a[2], a[0]), less(b[0], a[0]));
    const Arrow from_b = across(less(b[1], b[0]), less(b[2], b[0]), less(b[0], a[0]));
    return parts(from_a, of, high) || parts(from_b, of, high);
}

/// VERDICT_MEET if two triangles are certainly within a distance whose square is between `low` and `high`, VERDICT_APART if they are
/// certainly not, else VERDICT_UNSURE. The way between corners and the triangles' planes show most pairs, and take a tenth of the time of
/// all ways, which are asked if `with_all_ways`.
SHARED_FN uint likely_within(Corners p, Corners q, Real low, Real high, bool with_all_ways)
{
    if (have_common_corner(p, q))
        return VERDICT_MEET;
    const Spread spread = spread_of(p, q);
    const Way way = way_between_corners(spread);
    uint verdict = shown_by(way, spread, low, high);
    if (verdict == VERDICT_UNSURE && planes_part(spread, high))
        verdict = VERDICT_APART;
    if (verdict != VERDICT_UNSURE || !with_all_ways)
        return verdict;
    verdict = shown_by(shortest_way(spread, way), spread, low, high);
#if REAL_BITS == 64
    if (verdict == VERDICT_UNSURE && likely_meet(p, q) == VERDICT_MEET)
        return VERDICT_MEET;
#endif
    return verdict;
}

/// Returns the square of the distance of two triangles as computed, without a bound: 0 if the shortest way between their edges, corners and
/// faces does not separate them.
SHARED_FN Real computed_square(Corners p, Corners q)
{
    const Spread spread = spread_of(p, q);
    const Way way = shortest_way(spread, way_between_corners(spread));
    return gap_along(way.along, spread) > 0 ? way.square : (Real)0;
}

SHARED_END
#endif

#endif
