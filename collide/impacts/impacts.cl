// SPDX-License-Identifier: MIT
// check: -DMOST_STEPS=64u
//
// The narrow phase between two frames: which pairs of a vertex and a face, or of two edges, touch while all vertices move in
// straight lines. Conservative: a pair that touches is always found, whatever is rounded. docs/swept.md derives the bound.
//
// Two features touch at a time t if the hull of the differences of their vertices holds the origin. A vertex and a face have
// three differences, two edges four, which are the corners of a parallelogram. Along a fixed direction n each difference w has
// the component n w(t), which is linear in t. While all components are positive, n separates the features. Each step takes
// the direction to the point of the hull that is nearest to the origin, and goes on to the time until which it separates.
//
// One kernel serves both forms: it has no barriers, and an atomic per pair that touches is cheap beside the test.
#include "collide/found.clh"
#include "collide/narrow/narrow_words.h"

#define NEVER 2.0f  // a time after the step
// Error of a component n w of a difference whose coordinates are below 1, for an n whose coordinates are at most 1.
#define COMPONENT_ERROR 0x1p-19f
#define TIME_ERROR 0x1p-20f  // relative error of the time at which a linear function is zero

/// Differences of the vertices of two features in a frame, as the corners of a triangle or parallelogram, in order.
typedef struct {
    float3 at[4];
} Hull;

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

static inline float along(const float3 a, const float3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline float3 across(const float3 a, const float3 b)
{
    return (float3)(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline float longest(const float3 a) { return fmax(fmax(fabs(a.x), fabs(a.y)), fabs(a.z)); }

static inline float longest_of(const Hull hull)
{
    return fmax(fmax(longest(hull.at[0]), longest(hull.at[1])),
                fmax(longest(hull.at[2]), longest(hull.at[3])));
}

static inline float3 nearer(const float3 a, const float3 b)
{
    return along(b, b) < along(a, a) ? b : a;
}

/// Returns about the point of the hull that is nearest to the origin. Any result is safe; a good one saves steps.
static inline float3 nearest_point(const Hull hull)
{
    const float3 normal = across(hull.at[1] - hull.at[0], hull.at[2] - hull.at[0]);
    float3 nearest = hull.at[0];
    bool inside = true;  // whether the origin's projection onto the plane is in the hull
    for (uint k = 0u; k < 4u; ++k) {
        const float3 a = hull.at[k], b = hull.at[(k + 1u) % 4u];
        const float3 edge = b - a;
        const float share = -along(a, edge) / along(edge, edge);  // NaN for an edge without length
        nearest = nearer(nearest, share > 0.0f ? (share < 1.0f ? a + share * edge : b) : a);
        inside = inside && along(across(a, b), normal) >= 0.0f;
    }
    if (!inside)
        return nearest;
    return nearer(nearest, normal * (along(normal, hull.at[0]) / along(normal, normal)));
}

/// Returns the time until which `direction` certainly separates the features from `now` on; `now` if it does not.
static inline float separated_until(const Hull start, const Hull end, const float3 direction,
                                    const float now)
{
    const float length = longest(direction);
    if (!(length >= 0x1p-60f))
        return now;
    const float3 n = direction / length;
    float since = -1.0f, until = NEVER;
    for (uint k = 0u; k < 4u; ++k) {
        const float first = along(n, start.at[k]) - COMPONENT_ERROR;
        const float last = along(n, end.at[k]) - COMPONENT_ERROR;
        const float zero = first / (first - last);
        if (!(first > 0.0f || last > 0.0f))  // or NaN
            return now;
        if (!(first > 0.0f))
            since = fmax(since, zero * (1.0f + TIME_ERROR));
        if (!(last > 0.0f))
            until = fmin(until, zero * (1.0f - TIME_ERROR));
    }
    return since < now ? until : now;
}

static inline Hull scaled(Hull hull, const float factor)
{
    for (uint k = 0u; k < 4u; ++k)
        hull.at[k] *= factor;
    return hull;
}

/// Returns a time from 0 to 1 before which two features do not touch, or NEVER. If it is not NEVER, they are not farther apart
/// than `tolerance` then, or rounding or the number of steps hides that they are.
static inline float impact_time(global const Point* points, global const Point* end_points,
                                const Face first, const Face second, const float tolerance)
{
    const Hull unscaled_start = hull_of(points, first, second);
    const Hull unscaled_end = hull_of(end_points, first, second);
    const float size = fmax(longest_of(unscaled_start), longest_of(unscaled_end));
    if (!(size >= 0x1p-100f && size <= 0x1p100f))  // outside it, the bounds on errors do not hold
        return 0.0f;
    const float factor =
        as_float((253u - (as_uint(size) >> 23)) << 23);  // 2^k: all coordinates are below 1
    const Hull start = scaled(unscaled_start, factor), end = scaled(unscaled_end, factor);
    const float near = tolerance * factor;
    float now = 0.0f;
    for (uint step = 0u; step < MOST_STEPS; ++step) {
        Hull hull;
        for (uint k = 0u; k < 4u; ++k)
            hull.at[k] = start.at[k] + now * (end.at[k] - start.at[k]);
        const float3 direction = nearest_point(hull);
        const float until = separated_until(start, end, direction, now);
        if (until > 1.0f)
            return NEVER;
        if (along(direction, direction) <= near * near || !(until > now))
            return now;
        now = until;
    }
    return now;
}

/// Appends candidates that touch to `contacts`, and to `times` when they may do so first. `counters` must be zero.
kernel void find_impacts(global const Point* points, global const Point* end_points,
                         global const Face* faces, global const uint2* candidates,
                         global const uint* candidate_counters, const uint candidate_room,
                         global uint2* contacts, global float* times, const uint contact_room,
                         const float tolerance, volatile global uint* counters)
{
    const uint count = count_in_room(candidate_counters, candidate_room);
    uint looked_at = 0u;
    for (ulong place = get_global_id(0); place < count; place += get_global_size(0)) {
        ++looked_at;
        const uint2 pair = candidates[place];
        const Face first = faces[pair.x], second = faces[pair.y];
        if (share_a_vertex(first, second))
            continue;
        const float time = impact_time(points, end_points, first, second, tolerance);
        if (time > 1.0f)
            continue;
        const uint slot = add_wide(counters + CONTACTS_COUNT, 1u);
        if (slot < contact_room) {
            contacts[slot] = pair;
            times[slot] = time;
        }
    }
    add_wide(counters + NARROW_FLOAT_COUNT, looked_at);
}
