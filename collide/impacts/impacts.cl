// SPDX-License-Identifier: MIT
// check: -DMOST_STEPS=64u -DREAL_BITS=32 -DSEPARATED=0
// check: -DMOST_STEPS=64u -DREAL_BITS=32 -DSEPARATED=1
//
// The narrow phase between two frames: which pairs of a vertex and a face, or of two edges, touch while all vertices move in
// straight lines (advance.clh), all but those that share a vertex. Conservative: a pair that touches is always found.
#include "collide/found.clh"
#include "collide/moving/advance.clh"

static inline float3 difference(global const Point* points, const uint to, const uint from)
{
    const Point a = points[to], b = points[from];
    return (float3)(a.x - b.x, a.y - b.y, a.z - b.z);
}

/// Returns the hull of two edges (a, b, b), or of a vertex (a, a, a) and a face. The last corner of a face is given twice.
static inline Hull hull_of(global const Point* points, const Face first, const Face second)
{
    const bool edges = second.b == second.c;
    Hull hull;
    hull.at[0] = difference(points, second.a, first.a);
    hull.at[1] =
        edges ? difference(points, second.a, first.b) : difference(points, second.b, first.a);
    hull.at[2] =
        edges ? difference(points, second.b, first.b) : difference(points, second.c, first.a);
    hull.at[3] = difference(points, second.c, first.a);
    return hull;
}

static inline float longest_of(const Hull hull)
{
    return fmax(fmax(longest(hull.at[0]), longest(hull.at[1])),
                fmax(longest(hull.at[2]), longest(hull.at[3])));
}

static inline Hull scaled(Hull hull, const float factor)
{
    for (uint k = 0u; k < 4u; ++k)
        hull.at[k] *= factor;
    return hull;
}

/// Returns when two features may touch, as Impact says. `tolerance` and `separation` are lengths.
static inline float impact_time(global const Point* points, global const Point* end_points,
                                const Face first, const Face second, const float tolerance,
                                const float separation)
{
    const Hull start = hull_of(points, first, second), end = hull_of(end_points, first, second);
    const float difference = fmax(longest_of(start), longest_of(end));
    const float size = SEPARATED ? fmax(difference, separation) : difference;
    if (!(size >= 0x1p-100f && size <= 0x1p100f))  // outside it, the bounds on errors do not hold
        return 0.0f;
    const float factor =
        as_float((253u - (as_uint(size) >> 23)) << 23);  // 2^k: all coordinates are below 1
    return advance(scaled(start, factor), scaled(end, factor), tolerance * factor,
                   0x1p-126f * factor, separation * factor)
        .time;
}

typedef Point Vertices;
#define LOOKED_AT NARROW_FLOAT_COUNT
#include "collide/impacts/find_impacts.clh"
