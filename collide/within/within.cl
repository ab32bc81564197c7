// SPDX-License-Identifier: MIT
// check: -DGROUP_SIZE=256u -DKEEP_ADJACENT=0 -DREAL_BITS=32 -DTEST=1u -DFROM=0u -DLEFT=4u
// check: -DGROUP_SIZE=256u -DKEEP_ADJACENT=0 -DREAL_BITS=32 -DTEST=2u -DFROM=4u -DLEFT=6u
// check: -DGROUP_SIZE=1u -DKEEP_ADJACENT=1 -DREAL_BITS=64 -DTEST=2u -DFROM=0u -DLEFT=6u
// check: -DGROUP_SIZE=1u -DKEEP_ADJACENT=1 -DREAL_BITS=64 -DTEST=2u -DFROM=0u -DLEFT=6u -Xclang -cl-ext=-cl_khr_fp64,-__opencl_c_fp64
// check: -DGROUP_SIZE=256u -DKEEP_ADJACENT=0 -DREAL_BITS=64 -DTEST=3u -DFROM=0u -DLEFT=6u
// check: -DGROUP_SIZE=256u -DKEEP_ADJACENT=0 -DREAL_BITS=32 -DTEST=5u -DFROM=0u -DLEFT=6u
//
// Decides which candidates are within a distance (within.h). A work-group adds its pairs to a list at once, as one atomic of each wave took
// more than half of the time on an H200. One kernel serves both forms: in chunks a work-group has one work-item.
//
//     GROUP_SIZE of the work-group
//     TEST       WITHIN_ of narrow_words.h
//     FROM       where the counters have the number of candidates
//     LEFT       where they have that of pairs left over
#include "collide/found.clh"
#include "collide/narrow/narrow_words.h"
#include "collide/within/shapes.clh"

#if HAS_DOUBLES

/// Returns the verdict on triangles that share no vertex. The square of the distance is from `low` to `high`; `square` becomes it, if it is
/// computed.
static inline uint verdict_on(const Corners p, const Corners q, const Real low, const Real high,
                              Real* square)
{
    (void)low, (void)square;
#if TEST == WITHIN_CORNERS || TEST == WITHIN_WAYS
    if (REAL_BITS == 64 && (has_denormal(p) || has_denormal(q)))
        return VERDICT_UNSURE;
    return likely_within(p, q, low, high, TEST == WITHIN_WAYS);
#elif TEST == WITHIN_COMPUTED
    *square = computed_square(p, q);
    return *square <= high ? VERDICT_MEET : VERDICT_APART;
#else
    const Spread spread = spread_of(p, q);
    const Real distance = sqrt(high) * MORE;
    const bool part = TEST == WITHIN_ROUNDED_BOXES ? boxes_part(spread, distance)
                      : TEST == WITHIN_SPHERES     ? spheres_part(spread, distance)
                      : TEST == WITHIN_CAPSULES    ? capsules_part(spread, distance)
                                                   : false;
    return part ? VERDICT_APART : VERDICT_MEET;
#endif
}

static inline uint verdict_of(global const Point* points, global const Face* faces,
                              const uint2 pair, const Real low, const Real high, Real* square)
{
    const Face a = faces[pair.x], b = faces[pair.y];
    if (share_a_vertex(a, b))
        return KEEP_ADJACENT ? VERDICT_MEET : VERDICT_APART;
    return verdict_on(corners_of(points, a), corners_of(points, b), low, high, square);
}

/// `within` and `left` receive what fits; all are counted. `distances` are of the pairs within, if they are computed. `counters` must be zero
/// before the first pass.
kernel void decide_within(global const Point* points, global const Face* faces,
                          global const uint2* candidates, global const uint* candidate_counters,
                          const uint candidate_room, const Real low, const Real high,
                          global uint2* within, const uint within_room, global double* distances,
                          global uint2* left, const uint left_room, volatile global uint* counters)
{
    local uint of_group[2], slots[2];  // of pairs within, and left
    const uint count = count_in_room(candidate_counters + FROM, candidate_room);
    const uint lane = (uint)get_local_id(0);
    for (ulong first = (ulong)GROUP_SIZE * get_group_id(0); first < count;
         first += get_global_size(0)) {
        uint2 pair = (uint2)(0u, 0u);
        uint verdict = VERDICT_APART;
        Real square = 0;
        if (first + lane < count) {
            pair = candidates[first + lane];
            verdict = verdict_of(points, faces, pair, low, high, &square);
        }
        for (uint list = lane; list < 2u; list += GROUP_SIZE)
            of_group[list] = 0u;
        barrier(CLK_LOCAL_MEM_FENCE);
        const uint own = verdict == VERDICT_MEET ? 0u : 1u;
        const uint place = verdict == VERDICT_APART ? 0u : atomic_inc(&of_group[own]);
        barrier(CLK_LOCAL_MEM_FENCE);
        for (uint list = lane; list < 2u; list += GROUP_SIZE)
            if (of_group[list] != 0u)
                slots[list] =
                    add_wide(counters + (list == 0u ? CONTACTS_COUNT : LEFT), of_group[list]);
        barrier(CLK_LOCAL_MEM_FENCE);
        const ulong slot = (ulong)slots[own] + place;
        if (verdict == VERDICT_MEET && slot < within_room) {
            within[slot] = pair;
            if (TEST == WITHIN_COMPUTED)
                distances[slot] = sqrt(square);
        } else if (verdict == VERDICT_UNSURE && slot < left_room) {
            left[slot] = pair;
        }
    }
}

#endif
