// SPDX-License-Identifier: MIT
//
// Whether two triangles are within a distance of each other, decided in doubles where rounding cannot be the cause of the answer.
//
// Two certificates decide, however the points were found that they are about. Any point of one and any of the other are at least as far
// apart as the triangles. And if n . (b - a) is at least g for all corners a and b, then so it is for all points, which are at least
// g / |n| apart, whatever the vector n is. For n, from the nearest point to the nearest, both are the distance. That way is the shortest
// of those between two edges, nine pairs, and from a corner to its foot inside the other face, six.
//
// With u = 2^-53, all corners as differences from the first, at most M along each axis, and N the sum of the sizes of n's coordinates:
//
//     a corner            u M      a difference of floats
//     a side, a start     4 u M    a difference of two corners, at most 2 M
//     a coordinate of n   28 u M   a start and two sides with shares of at most 1; three sums; a foot off its face by u: 64 u M covers it
//     n . b - n . a       12 u M N two products of three terms, 4 u M N each; two differences, 2 u M N each: 16 u M N covers it
//
// So the square of the distance is at most n . n + 4 * 64 u M (N + 64 u M), and n . (b - a) at least what is computed less 16 u M N, up
// to factors of squares and sums, and of the square that they are compared with: 1 + 10 u in all, which 1 + 16 u covers. Floats are
// multiples of 2^-149, so M is 0 or at least that: with N of at least 2^-400, what underflows is less than the smallest part of a bound.
// Sums of squares are below 2^524.
#ifndef BVHBENCH_COLLIDE_DISTANCE_FILTER_H
#define BVHBENCH_COLLIDE_DISTANCE_FILTER_H

#include "collide/narrow/double_filter.h"

#if HAS_DOUBLES
SHARED_BEGIN

/// Corners as differences from one point.
typedef struct {
    Vector at[3];
} Spread;

/// The way from a point of one triangle to a point of the other, and the square of its length.
typedef struct {
    Vector along;
    double square;
} Way;

SHARED_FN_INLINED Vector less(Vector a, Vector b)
{
    const Vector v = {a.x - b.x, a.y - b.y, a.z - b.z};
    return v;
}

/// Returns a - s b.
SHARED_FN_INLINED Vector less_share(Vector a, double s, Vector b)
{
    const Vector v = {a.x - s * b.x, a.y - s * b.y, a.z - s * b.z};
    return v;
}

SHARED_FN_INLINED double share_of(double s) { return s < 0.0 ? 0.0 : (s > 1.0 ? 1.0 : s); }

SHARED_FN_INLINED Way shorter(Way a, Vector along)
{
    const Way b = {along, dot(along, along)};
    return b.square < a.square ? b : a;
}

/// Returns the shortest way from the edge with side u to the one with side v, which starts at w from the start of the first.
SHARED_FN_INLINED Vector way_between(Vector w, Vector u, Vector v)
{
    const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w);
    const double area = uu * vv - uv * uv;
    const double near = area > 0.0 ? share_of((uw * vv - uv * vw) / area) : 0.0;
    const double t = vv > 0.0 ? share_of((uv * near - vw) / vv) : 0.0;
    const double s = uu > 0.0 ? share_of((uw + uv * t) / uu) : 0.0;
    return less_share(less_share(w, s, u), -t, v);
}

/// Returns the way to w from its foot in the plane of the sides u and v; if that is outside of the triangle, from a corner.
SHARED_FN_INLINED Vector way_over(Vector w, Vector u, Vector v)
{
    const Vector normal = cross_product(u, v);
    const double square = dot(normal, normal);
    const double s = square > 0.0 ? dot(cross_product(w, v), normal) / square : -1.0;
    const double t = square > 0.0 ? dot(cross_product(u, w), normal) / square : -1.0;
    const bool is_inside = s >= 0.0 && t >= 0.0 && s + t <= 1.0;
    return is_inside ? less_share(less_share(w, s, u), t, v) : w;
}

SHARED_FN_INLINED double largest(Vector a) { return fmax(fmax(fabs(a.x), fabs(a.y)), fabs(a.z)); }

/// Returns the shortest way between two corners.
SHARED_FN_INLINED Way way_between_corners(Spread a, Spread b)
{
    Way best = {less(b.at[0], a.at[0]), 0.0};
    best.square = dot(best.along, best.along);
    for (uint k = 1u; k < 9u; ++k)
        best = shorter(best, less(b.at[k % 3u], a.at[k / 3u]));
    return best;
}

/// Returns the shortest way between two triangles that do not meet, but for rounding.
SHARED_FN Way shortest_way(Spread a, Spread b, Way best)
{
    for (uint k = 0u; k < 9u; ++k) {
        const uint i = k / 3u, j = k % 3u;
        best = shorter(best, way_between(less(b.at[j], a.at[i]), less(a.at[(i + 1u) % 3u], a.at[i]),
                                         less(b.at[(j + 1u) % 3u], b.at[j])));
    }
    for (uint k = 0u; k < 3u; ++k) {
        best = shorter(
            best, way_over(less(b.at[k], a.at[0]), less(a.at[1], a.at[0]), less(a.at[2], a.at[0])));
        const Vector back =
            way_over(less(a.at[k], b.at[0]), less(b.at[1], b.at[0]), less(b.at[2], b.at[0]));
        const Vector along = {-back.x, -back.y, -back.z};
        best = shorter(best, along);
    }
    return best;
}

/// What a way certainly shows of two triangles whose corners are up to `size` along each axis; else VERDICT_UNSURE. The square of the
/// distance is between `low` and `high`.
SHARED_FN_INLINED uint shown_by(Way way, Spread a, Spread b, double size, double low, double high)
{
    const Vector n = way.along;
    const double sum = fabs(n.x) + fabs(n.y) + fabs(n.z), slack = 0x1p-47 * size;
    const double most = way.square + 4.0 * slack * (sum + slack);
    if (most * (1.0 + 0x1p-49) <= low)
        return VERDICT_MEET;
    const double from = fmin(fmin(dot(n, b.at[0]), dot(n, b.at[1])), dot(n, b.at[2]));
    const double to = fmax(fmax(dot(n, a.at[0]), dot(n, a.at[1])), dot(n, a.at[2]));
    const double gap = from - to - 0x1p-49 * size * sum;
    const bool is_beyond = sum >= 0x1p-400 && gap > 0.0 &&
                           gap * gap * (1.0 - 0x1p-49) > high * (way.square * (1.0 + 0x1p-49));
    return is_beyond ? VERDICT_APART : VERDICT_UNSURE;
}

/// VERDICT_MEET if two triangles are certainly within a distance whose square is between `low` and `high`, VERDICT_APART if they are
/// certainly not, else VERDICT_UNSURE. `low` and `high` are doubles nearest to what they stand for.
SHARED_FN uint likely_within(Corners p, Corners q, double low, double high)
{
    if (have_common_place(p, q))
        return VERDICT_MEET;
    const Point from = p.at[0];
    const Spread a = {
        {difference(from, from), difference(p.at[1], from), difference(p.at[2], from)}};
    const Spread b = {
        {difference(q.at[0], from), difference(q.at[1], from), difference(q.at[2], from)}};
    const double size = fmax(fmax(fmax(largest(a.at[1]), largest(a.at[2])), largest(b.at[0])),
                             fmax(largest(b.at[1]), largest(b.at[2])));
    Way way = way_between_corners(
        a, b);  // that of corners shows most pairs, and takes a tenth of the time
    uint verdict = shown_by(way, a, b, size, low, high);
    if (verdict != VERDICT_UNSURE)
        return verdict;
    way = shortest_way(a, b, way);
    verdict = shown_by(way, a, b, size, low, high);
    if (verdict != VERDICT_UNSURE)
        return verdict;
    return likely_meet(p, q) == VERDICT_MEET ? VERDICT_MEET : VERDICT_UNSURE;
}

SHARED_END
#endif

#endif
