// SPDX-License-Identifier: MIT
// check: -include collide/narrow/verdict.clh -DGROUP_SIZE=128u -DKEEP_ADJACENT=0 -DWITH_DOUBLES=1
// check: -include collide/narrow/verdict.clh -DGROUP_SIZE=128u -DKEEP_ADJACENT=1 -DWITH_DOUBLES=1
// check: -include collide/narrow/verdict.clh -DGROUP_SIZE=128u -DKEEP_ADJACENT=0 -DWITH_DOUBLES=0 -Xclang -cl-ext=-cl_khr_fp64,-__opencl_c_fp64
// check: -include collide/narrow/rounded.clh -DGROUP_SIZE=128u -DROUNDED_TEST=1 -DREAL_BITS=32
// check: -include collide/narrow/rounded.clh -DGROUP_SIZE=128u -DROUNDED_TEST=2 -DREAL_BITS=32 -Xclang -cl-ext=-cl_khr_fp64,-__opencl_c_fp64
// check: -include collide/narrow/rounded.clh -DGROUP_SIZE=128u -DROUNDED_TEST=2 -DREAL_BITS=64
// check: -include collide/narrow/rounded.clh -DGROUP_SIZE=128u -DROUNDED_TEST=3 -DREAL_BITS=32
//
// The work-group form of the narrow phase: one candidate per work-item and iteration. What floats leave open waits in local memory
// until there is one for each work-item, since a warp takes as long for one pair in doubles as for 32. Contacts and unsure candidates
// are in the lists of sinks/lists_groups.clh. Compiled behind the header that defines the verdicts on a candidate.
#define ITEMS 4u
#include "collide/narrow/narrow_words.h"
#include "collide/sinks/lists_groups.clh"

#define OPEN_ROOM (2u * GROUP_SIZE)  // fewer than GROUP_SIZE wait when an iteration begins

/// Keeps a pair by its verdict. Adds to the numbers of pairs that floats and doubles decided.
static inline void keep_by(LISTS_PARAMETERS, const uint2 pair, const uint verdict, uint* by_floats,
                           uint* by_doubles)
{
    *by_doubles += verdict & BY_DOUBLES ? 1u : 0u;
    *by_floats += verdict == VERDICT_APART || verdict == VERDICT_MEET ? 1u : 0u;
    if ((verdict & VERDICT_MEET) != 0u)
        keep_node(LISTS, pair);
    if ((verdict & VERDICT_UNSURE) != 0u)
        keep_pair(LISTS, pair);
}

/// Tests all candidates; `counters` must be zero, and `next_counters` are zero afterwards. `contacts` and `unsure` receive what fits;
/// everything is counted.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void filter_pairs(
    global const Point* points, global const Face* faces, global const uint2* candidates,
    global const uint* candidate_counters, const uint candidate_room, global uint2* contacts,
    const uint contact_room, global uint2* unsure, const uint unsure_room,
    volatile global uint* counters, global uint* next_counters)
{
    local uint2 kept[KEPT], open[OPEN_ROOM];
    local uint kept_counts[3], counts[2], slots[2], decided[2];
    const uint item = (uint)get_local_id(0);
    const uint count = count_in_room(candidate_counters, candidate_room);
    const ulong a_turn = get_global_size(0);
    const uint group_first = (uint)get_group_id(0) * GROUP_SIZE;
    const uint turns =
        count > group_first ? (uint)((count - group_first + a_turn - 1ul) / a_turn) : 0u;
    if (item < 3u)
        kept_counts[item] = 0u;
    if (item < 2u)
        decided[item] = 0u;
    zero_next(next_counters, NARROW_COUNTERS);
    barrier(CLK_LOCAL_MEM_FENCE);
    uint by_floats = 0u, by_doubles = 0u;
    for (uint turn = 0u; turn < turns; ++turn) {
        const bool is_last = turn + 1u == turns;
        const ulong place = turn * a_turn + get_global_id(0);
        if (place < count) {
            const uint2 pair = candidates[place];
            const uint verdict = first_verdict(points, faces[pair.x], faces[pair.y]);
            if (verdict == VERDICT_OPEN)
                open[atomic_inc(&kept_counts[2])] = pair;
            else
                keep_by(LISTS, pair, verdict, &by_floats, &by_doubles);
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        uint waiting = kept_counts[2];
        while (waiting >= GROUP_SIZE || (is_last && waiting > 0u)) {
            const uint now = min(waiting, GROUP_SIZE);
            waiting -= now;
            if (item < now) {
                const uint2 pair = open[waiting + item];
                keep_by(LISTS, pair, second_verdict(points, faces[pair.x], faces[pair.y]),
                        &by_floats, &by_doubles);
            }
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        const bool is_full = kept_counts[0] + kept_counts[1] > KEPT - OPEN_ROOM;
        barrier(CLK_LOCAL_MEM_FENCE);
        if (item == 2u)
            kept_counts[2] = waiting;
        if (is_full || is_last) {
            if (item < 2u)
                take_slots(kept_counts, item, counts, slots,
                           counters + (item == 0u ? CONTACTS_COUNT : NARROW_EXACT_COUNT));
            barrier(CLK_LOCAL_MEM_FENCE);
            write_out(kept, 0u, 1, counts[0], contacts, slots[0], contact_room);
            write_out(kept, KEPT - 1u, -1, counts[1], unsure, slots[1], unsure_room);
        }
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    atomic_add(&decided[0], by_floats);
    atomic_add(&decided[1], by_doubles);
    barrier(CLK_LOCAL_MEM_FENCE);
    if (item < 2u && decided[item] != 0u)
        add_wide(counters + (item == 0u ? NARROW_FLOAT_COUNT : NARROW_DOUBLE_COUNT), decided[item]);
}
