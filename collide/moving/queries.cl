// SPDX-License-Identifier: MIT
// check: -DMOST_STEPS=64u -DREAL_BITS=32 -DANSWER=1 -DSEPARATED=0
// check: -DMOST_STEPS=64u -DREAL_BITS=64 -DANSWER=1 -DSEPARATED=1
// check: -DMOST_STEPS=64u -DREAL_BITS=64 -DANSWER=2 -DSEPARATED=1
// check: -DMOST_STEPS=64u -DREAL_BITS=64 -DANSWER=3 -DSEPARATED=0
//
// Queries of moving points in doubles, without a tree: when does each touch first?
//
//     ANSWER    1: advance.clh, which misses nothing; 2: additive.clh, 3: roots.clh, as computed and without a separation
#include "collide/moving/advance.clh"
#if HAS_DOUBLES
#include "collide/moving/additive.clh"
#include "collide/moving/roots.clh"

/// Returns vertex `vertex` of query `place`. Each of the 12 coordinates of a frame is an array of `count`.
static inline double3 vertex_of(global const double* points, const uint vertex, const uint place,
                                const uint count)
{
    global const double* x = points + 3ul * vertex * count + place;
    return (double3)(x[0], x[count], x[2ul * count]);
}

/// Returns the hull of edges 0 1 and 2 3, or of vertex 0 and the face 1 2 3.
static inline void differences_of(const double3* at, const uint of_edges, double3* hull)
{
    hull[0] = of_edges ? at[2] - at[0] : at[1] - at[0];
    hull[1] = of_edges ? at[2] - at[1] : at[2] - at[0];
    hull[2] = of_edges ? at[3] - at[1] : at[3] - at[0];
    hull[3] = at[3] - at[0];
}

static inline double longest_in(const double3* hull)
{
    double longest = 0.0;
    for (uint k = 0u; k < 4u; ++k)
        longest = fmax(longest, fmax(fmax(fabs(hull[k].x), fabs(hull[k].y)), fabs(hull[k].z)));
    return longest;
}

static inline Hull scaled(const double3* hull, const double factor)
{
    Hull rounded;
    for (uint k = 0u; k < 4u; ++k)
        rounded.at[k] = (Real3)((Real)(factor * hull[k].x), (Real)(factor * hull[k].y),
                                (Real)(factor * hull[k].z));
    return rounded;
}

/// Writes for each query a time from 0 to 1, or NEVER. `from` and `to` have 12 arrays of `count`. `tolerance` is a share of the largest
/// difference between vertices of the two features along an axis, and `separation` a length. Counts in `cut_short` the queries that a
/// limit of steps ended.
kernel void time_impacts(global const double* from, global const double* to, const uint of_edges,
                         const uint count, const double tolerance, const double separation,
                         global double* times, volatile global uint* cut_short)
{
    for (uint place = get_global_id(0); place < count; place += get_global_size(0)) {
        double3 at[4], end_at[4], start[4], end[4];
        for (uint k = 0u; k < 4u; ++k) {
            at[k] = vertex_of(from, k, place, count);
            end_at[k] = vertex_of(to, k, place, count);
        }
        differences_of(at, of_edges, start);
        differences_of(end_at, of_edges, end);
        const double size = fmax(longest_in(start), longest_in(end));
        const double most = SEPARATED ? fmax(size, separation) : size;
        Impact impact = {0, false};
        if (most >= 0x1p-900 && most <= 0x1p900) {  // outside it, the bounds on errors do not hold
            // 2^k: all coordinates are below 1
            const double factor = as_double((2045ul - (as_ulong(most) >> 52)) << 52);
            const Real apart = SEPARATED ? (Real)(separation * factor) : 0;
            const Hull first = scaled(start, factor), last = scaled(end, factor);
#if ANSWER == 2
            impact = add_up(first, last, most_motion(at, end_at, of_edges) * factor, apart);
            (void)tolerance;
#else
            const Real near = (Real)(tolerance * size * factor);
            impact =
                ANSWER == 1 ? advance(first, last, near, 0, apart) : first_root(first, last, near);
#endif
        }
        times[place] = impact.time;
        if (impact.is_cut_short)
            atomic_inc(cut_short);
    }
}

#endif
