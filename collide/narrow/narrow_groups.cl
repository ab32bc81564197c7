// SPDX-License-Identifier: MIT
// check: -include collide/narrow/verdict.clh -DGROUP_SIZE=128u -DKEEP_ADJACENT=0 -DWITH_DOUBLES=1
// check: -include collide/narrow/verdict.clh -DGROUP_SIZE=128u -DKEEP_ADJACENT=1 -DWITH_DOUBLES=1
// check: -include collide/narrow/verdict.clh -DGROUP_SIZE=128u -DKEEP_ADJACENT=0 -DWITH_DOUBLES=0 -Xclang -cl-ext=-cl_khr_fp64,-__opencl_c_fp64
// check: -include collide/narrow/rounded_verdict.clh -DGROUP_SIZE=128u -DROUNDED_TEST=1 -DREAL_BITS=32
// check: -include collide/narrow/rounded_verdict.clh -DGROUP_SIZE=128u -DROUNDED_TEST=2 -DREAL_BITS=32 -Xclang -cl-ext=-cl_khr_fp64,-__opencl_c_fp64
// check: -include collide/narrow/rounded_verdict.clh -DGROUP_SIZE=128u -DROUNDED_TEST=2 -DREAL_BITS=64
//
// Compiled behind the header that says what a candidate is. Candidates in groups: one a work-item a turn. What a group keeps of a turn it lines up in local memory, contacts from
// the front and unsure ones from the back, and writes out with one atomic each.
#include "collide/narrow/narrow_counters.h"
#include "collide/wide_count.clh"

/// Write `count` of `kept`, from `first` on in steps of `by`, to `out` from `slot` on, as far as there is room.
static inline void write_kept(local const uint2* kept, const uint first, const int by,
                              const uint count, global uint2* out, const uint slot,
                              const uint capacity)
{
    const uint room = capacity - min(capacity, slot);
    for (uint k = (uint)get_local_id(0); k < min(count, room); k += GROUP_SIZE)
        out[slot + k] = kept[(int)first + by * (int)k];
}

/// `counters` are zero. Afterwards `contacts` and `unsure` begin with what there was room for; all is counted.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void filter_pairs(
    global const Point* points, global const Face* faces, global const uint2* candidates,
    global const uint* candidate_counters, const uint candidate_room, global uint2* contacts,
    const uint contact_room, global uint2* unsure, const uint unsure_room,
    volatile global uint* counters)
{
    local uint2 kept[GROUP_SIZE];
    local uint kept_counts[2], counts[2], slots[2], decided[2];
    const uint item = (uint)get_local_id(0);
    const uint count = candidate_count(candidate_counters, candidate_room);
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
                kept[atomic_inc(&kept_counts[0])] = pair;
            if ((verdict & VERDICT_UNSURE) != 0u)
                kept[GROUP_SIZE - 1u - atomic_inc(&kept_counts[1])] = pair;
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        if (item < 2u) {
            counts[item] = kept_counts[item];
            kept_counts[item] = 0u;
            volatile global uint* total =
                counters + (item == 0u ? CONTACTS_COUNT : NARROW_EXACT_COUNT);
            slots[item] = counts[item] != 0u ? add_wide(total, counts[item]) : 0u;
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        write_kept(kept, 0u, 1, counts[0], contacts, slots[0], contact_room);
        write_kept(kept, GROUP_SIZE - 1u, -1, counts[1], unsure, slots[1], unsure_room);
        barrier(CLK_LOCAL_MEM_FENCE);
    }
    atomic_add(&decided[0], by_floats);
    atomic_add(&decided[1], by_doubles);
    barrier(CLK_LOCAL_MEM_FENCE);
    if (item < 2u && decided[item] != 0u)
        add_wide(counters + (item == 0u ? NARROW_FLOAT_COUNT : NARROW_DOUBLE_COUNT), decided[item]);
}
