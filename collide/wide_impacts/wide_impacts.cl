// SPDX-License-Identifier: MIT
// check: -DMOST_STEPS=64u -DREAL_BITS=64 -DWIDE_POINTS=0 -DSEPARATED=0
// check: -DMOST_STEPS=64u -DREAL_BITS=64 -DWIDE_POINTS=1 -DSEPARATED=1
//
// The narrow phase between two frames, as collide/impacts/impacts.cl, in doubles: pairs are tested as single queries are
// (collide/moving/queries.cl). Conservative: a pair that touches is always found.
//
//     WIDE_POINTS    1: coordinates are doubles; 0: floats
#define ANSWER 1
#include "collide/found.clh"
#include "collide/moving/queries.cl"
#if HAS_DOUBLES

#if WIDE_POINTS
typedef double Coordinate;
static inline double exactly(const double x) { return x; }
#else
typedef uint Coordinate;  // the bits of a float

/// Returns a float as a double without an error. Converted as a whole, denormal floats may become 0.
static inline double exactly(const uint bits)
{
    const uint size = bits & 0x7fffffffu;
    const double x = size < 0x00800000u ? 0x1p-149 * (double)size : (double)as_float(size);
    return size == bits ? x : -x;
}
#endif

static inline double3 position(global const Coordinate* points, const uint vertex)
{
    global const Coordinate* x = points + 3ul * vertex;
    return (double3)(exactly(x[0]), exactly(x[1]), exactly(x[2]));
}

/// Writes the differences of the vertices of two edges (a, b, b), or of a vertex (a, a, a) and a face.
static inline void hull_of(global const Coordinate* points, const Face first, const Face second,
                           double3* hull)
{
    const uint of_edges = second.b == second.c ? 1u : 0u;
    const double3 at[4] = {position(points, first.a),
                           position(points, of_edges ? first.b : second.a),
                           position(points, of_edges ? second.a : second.b),
                           position(points, of_edges ? second.b : second.c)};
    differences_of(at, of_edges, hull);
}

/// Returns the largest float that is not above `time`, which is not negative.
static inline float rounded_down(const double time)
{
    const float nearest = (float)time;
    return as_float(as_uint(nearest) - ((double)nearest > time ? 1u : 0u));
}

/// Returns when two features may touch, as Impact says. `tolerance` and `separation` are lengths.
static inline float impact_time(global const Coordinate* points,
                                global const Coordinate* end_points, const Face first,
                                const Face second, const double tolerance, const double separation)
{
    double3 start[4], end[4];
    hull_of(points, first, second, start);
    hull_of(end_points, first, second, end);
    const double difference = fmax(longest_in(start), longest_in(end));
    const double size = SEPARATED ? fmax(difference, separation) : difference;
    if (!(size >= 0x1p-900 && size <= 0x1p900))  // outside it, the bounds on errors do not hold
        return 0.0f;
    const double factor =
        as_double((2045ul - (as_ulong(size) >> 52)) << 52);  // 2^k: all coordinates are below 1
    return rounded_down(advance(scaled(start, factor), scaled(end, factor), tolerance * factor, 0,
                                separation * factor)
                            .time);
}

typedef Coordinate Vertices;
#define LOOKED_AT NARROW_DOUBLE_COUNT
#include "collide/impacts/find_impacts.clh"

#endif
