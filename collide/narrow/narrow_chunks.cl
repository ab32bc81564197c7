// SPDX-License-Identifier: MIT
// check: -DSINK_BLOCK=512u -DKEEP_ADJACENT=0 -DWITH_DOUBLES=1
// check: -DSINK_BLOCK=512u -DKEEP_ADJACENT=1 -DWITH_DOUBLES=1
// check: -DSINK_BLOCK=512u -DKEEP_ADJACENT=1 -DWITH_DOUBLES=0 -Xclang -cl-ext=-cl_khr_fp64,-__opencl_c_fp64
//
// The chunk form: work-items take batches of candidates from a counter, and collect contacts and unsure ones in own blocks.
//
// Each step over a batch is a branch-free loop over coordinates stored side by side, so that the compiler vectorises it:
//
//     batch         corners, gathered               -> open: neither plane separates the two
//     open ones     their corners, moved together   -> verdicts, in doubles
//     unsure ones   left to exact arithmetic
#include "collide/narrow/verdict.clh"
#include "collide/sinks/sink_chunks.clh"

#define BATCH 256u

/// Corners of pairs of triangles, one array per coordinate: corner c of pair k has its x at [3 c][k].
typedef struct {
    float at[18][BATCH];
} Batch;

static inline Point corner(const Batch* batch, const uint c, const uint k)
{
    const Point p = {batch->at[3u * c][k], batch->at[3u * c + 1u][k], batch->at[3u * c + 2u][k]};
    return p;
}

static inline void set_corner(Batch* batch, const uint c, const uint k, const Point p)
{
    batch->at[3u * c][k] = p.x;
    batch->at[3u * c + 1u][k] = p.y;
    batch->at[3u * c + 2u][k] = p.z;
}

/// Gathers the corners of `count` candidates, and marks in `adjacent` those that share a corner.
static inline void gather_pairs(global const Point* points, global const Face* faces,
                                global const uint2* candidates, const uint count, Batch* batch,
                                uint* adjacent)
{
    for (uint k = 0u; k < count; ++k) {
        const uint2 pair = candidates[k];
        const Face a = faces[pair.x], b = faces[pair.y];
        adjacent[k] = share_a_vertex(a, b) ? 1u : 0u;
        set_corner(batch, 0u, k, points[a.a]);
        set_corner(batch, 1u, k, points[a.b]);
        set_corner(batch, 2u, k, points[a.c]);
        set_corner(batch, 3u, k, points[b.a]);
        set_corner(batch, 4u, k, points[b.b]);
        set_corner(batch, 5u, k, points[b.c]);
    }
}

/// Writes to `list` the pairs that floats leave open, and adjacent pairs if they are kept; returns their number.
static inline uint open_pairs(const Batch* batch, const uint count, const uint* adjacent,
                              uint* list)
{
    uint open[BATCH];
    for (uint k = 0u; k < count; ++k) {
        const Point a = corner(batch, 0u, k), b = corner(batch, 1u, k), c = corner(batch, 2u, k);
        const Point p = corner(batch, 3u, k), q = corner(batch, 4u, k), r = corner(batch, 5u, k);
        const bool parted = plane_parts(a, b, c, p, q, r) || plane_parts(p, q, r, a, b, c);
        open[k] = adjacent[k] != 0u ? (uint)KEEP_ADJACENT : (parted ? 0u : 1u);
    }
    uint found = 0u;
    for (uint k = 0u; k < count; ++k) {
        list[found] = k;
        found += open[k];
    }
    return found;
}

/// Writes the verdicts of the open pairs, computed as if none were adjacent. Moves their corners to the front of the batch.
static inline void verdicts_of(Batch* batch, const uint* list, const uint count, uint* verdicts)
{
#if FILTER_DOUBLES
    for (uint c = 0u; c < 18u; ++c)
        for (uint k = 0u; k < count; ++k)
            batch->at[c][k] = batch->at[c][list[k]];
    for (uint k = 0u; k < count; ++k) {
        const Corners a = {{corner(batch, 0u, k), corner(batch, 1u, k), corner(batch, 2u, k)}};
        const Corners b = {{corner(batch, 3u, k), corner(batch, 4u, k), corner(batch, 5u, k)}};
        const uint verdict = likely_meet_unbranched(a, b);
        verdicts[k] = verdict == VERDICT_UNSURE ? verdict : verdict | BY_DOUBLES;
    }
#else
    (void)batch, (void)list;
    for (uint k = 0u; k < count; ++k)
        verdicts[k] = VERDICT_UNSURE;
#endif
}

/// As `filter_pairs` in narrow_groups.cl. `blocks` has room for 2 SINK_BLOCK pairs per work-item.
kernel void filter_pairs(global const Point* points, global const Face* faces,
                         global const uint2* candidates, global const uint* candidate_counters,
                         const uint candidate_room, global uint2* contacts, const uint contact_room,
                         global uint2* unsure, const uint unsure_room,
                         volatile global uint* counters, global uint* next_counters,
                         global uint2* blocks)
{
    zero_next(next_counters, NARROW_COUNTERS);
    const uint count = count_in_room(candidate_counters, candidate_room);
    global uint2* const own = blocks + 2u * SINK_BLOCK * get_global_id(0);
    List meeting = {own, 0u, contacts, contact_room, counters + CONTACTS_COUNT};
    List doubtful = {own + SINK_BLOCK, 0u, unsure, unsure_room, counters + NARROW_EXACT_COUNT};
    uint by_floats = 0u, by_doubles = 0u;
    Batch batch;
    uint adjacent[BATCH], list[BATCH], verdicts[BATCH];
    for (ulong first = (ulong)BATCH * atomic_inc(counters + BATCHES_BEGUN); first < count;
         first = (ulong)BATCH * atomic_inc(counters + BATCHES_BEGUN)) {
        const uint in_batch = (uint)min((ulong)BATCH, count - first);
        gather_pairs(points, faces, candidates + first, in_batch, &batch, adjacent);
        const uint open = open_pairs(&batch, in_batch, adjacent, list);
        by_floats += in_batch - open;
        verdicts_of(&batch, list, open, verdicts);
        for (uint k = 0u; k < open; ++k) {
            const uint2 pair = candidates[first + list[k]];
            const uint verdict = adjacent[list[k]] != 0u
                                     ? second_verdict(points, faces[pair.x], faces[pair.y])
                                     : verdicts[k];
            by_doubles += verdict & BY_DOUBLES ? 1u : 0u;
            by_floats += verdict == VERDICT_MEET ? 1u : 0u;
            if ((verdict & VERDICT_MEET) != 0u)
                put(&meeting, pair);
            if ((verdict & VERDICT_UNSURE) != 0u)
                put(&doubtful, pair);
        }
    }
    close_sink(&meeting);
    close_sink(&doubtful);
    add_wide(counters + NARROW_FLOAT_COUNT, by_floats);
    add_wide(counters + NARROW_DOUBLE_COUNT, by_doubles);
}
