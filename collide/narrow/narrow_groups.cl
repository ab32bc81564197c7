// SPDX-License-Identifier: MIT
// check: -include collide/narrow/verdict.clh -DGROUP_SIZE=128u -DKEEP_ADJACENT=0 -DWITH_DOUBLES=1
// check: -include collide/narrow/verdict.clh -DGROUP_SIZE=128u -DKEEP_ADJACENT=1 -DWITH_DOUBLES=1
// check: -include collide/narrow/verdict.clh -DGROUP_SIZE=128u -DKEEP_ADJACENT=0 -DWITH_DOUBLES=0 -Xclang -cl-ext=-cl_khr_fp64,-__opencl_c_fp64
// check: -include collide/narrow/rounded.clh -DGROUP_SIZE=128u -DROUNDED_TEST=1 -DREAL_BITS=32
// check: -include collide/narrow/rounded.clh -DGROUP_SIZE=128u -DROUNDED_TEST=2 -DREAL_BITS=32 -Xclang -cl-ext=-cl_khr_fp64,-__opencl_c_fp64
// check: -include collide/narrow/rounded.clh -DGROUP_SIZE=128u -DROUNDED_TEST=2 -DREAL_BITS=64
// check: -include collide/narrow/rounded.clh -DGROUP_SIZE=128u -DROUNDED_TEST=3 -DREAL_BITS=32
//
// The work-group form of the narrow phase: one candidate per work-item and iteration. Contacts and unsure candidates are in the
// lists of sinks/lists_groups.clh. Compiled behind the header that defines the verdict on a candidate.
#define ITEMS 1u
#include "collide/narrow/narrow_words.h"
#include "collide/sinks/lists_groups.clh"

/// Tests all candidates; `counters` must be zero. `contacts` and `unsure` receive what fits; everything is counted.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void filter_pairs(
    global const Point* points, global const Face* faces, global const uint2* candidates,
    global const uint* candidate_counters, const uint candidate_room, global uint2* contacts,
    const uint contact_room, global uint2* unsure, const uint unsure_room,
    volatile global uint* counters)
{
    local uint2 kept[KEPT];
    local uint kept_counts[2], counts[2], slots[2], decided[2];
    const uint item = (uint)get_local_id(0);
    const uint count = count_in_room(candidate_counters, candidate_room);
    const ulong a_turn = get_global_size(0);
    const uint turns = (uint)((count + a_turn - 1ul) / a_turn);
    if (item < 2u) {
        kept_counts[item] = 0u;
        decided[item] = 0u;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    uint by_floats = 0u, by_doubles = 0u;
    for (uint turn = 0u; turn < turns; ++turn) {
        const ulong place = turn * a_turn + get_global_id(0);
        if (place < count) {
            const uint2 pair = candidates[place];
            const uint verdict = first_verdict(points, faces[pair.x], faces[pair.y]);
            by_doubles += verdict & BY_DOUBLES ? 1u : 0u;
            by_floats += verdict == VERDICT_APART || verdict == VERDICT_MEET ? 1u : 0u;
            if ((verdict & VERDICT_MEET) != 0u)
                keep_node(LISTS, pair);
            if ((verdict & VERDICT_UNSURE) != 0u)
                keep_pair(LISTS, pair);
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        if (item < 2u)
            take_slots(kept_counts, item, counts, slots,
                       counters + (item == 0u ? CONTACTS_COUNT : NARROW_EXACT_COUNT));
        barrier(CLK_LOCAL_MEM_FENCE);
        write_out(kept, 0u, 1, counts[0], contacts, slots[0], contact_room);
        write_out(kept, KEPT - 1u, -1, counts[1], unsure, slots[1], unsure_room);
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    atomic_add(&decided[0], by_floats);
    atomic_add(&decided[1], by_doubles);
    barrier(CLK_LOCAL_MEM_FENCE);
    if (item < 2u && decided[item] != 0u)
        add_wide(counters + (item == 0u ? NARROW_FLOAT_COUNT : NARROW_DOUBLE_COUNT), decided[item]);
}
