// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DGROUP_SIZE=64u -DLABEL_BITS=20 -DORDERED=1
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DGROUP_SIZE=64u -DLABEL_BITS=32 -DORDERED=0
//
// Front tracking by work-groups: an entry of the front, or a leaf and a tree, per work-item.
#include "collide/sinks/sink_groups.clh"

#define ENTRIES_PARAMETERS                                                      \
    global uint2 *next, const uint next_room, volatile global uint *next_count, \
        volatile global uint *bin_counts, const uint writes
#define ENTRIES next, next_room, next_count, bin_counts, writes

static inline void put_entry(ENTRIES_PARAMETERS, const uint2 entry, const uint bin)
{
    if (writes == 0u)
        return;
    const uint slot = add_wide(next_count, 1u);
    if (slot < next_room)
        next[slot] = entry;
#if ORDERED
    atomic_inc(bin_counts + bin);
#endif
    (void)bin, (void)bin_counts;
}

#include "collide/front/leaf_front.clh"

/// Finds the pairs below the `standing` entries of `front`. If `writes` is set, also maintains: `next` receives the next front,
/// `bin_counts` the number of entries in each bin. What exceeds a capacity is counted, not written.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void advance(
    FOREST_PARAMETERS, global const uint* ropes, global const Face* faces, global uint2* pairs,
    const uint capacity, volatile global uint* counters, global uint2* next, const uint next_room,
    volatile global uint* bin_counts, global const uint2* front, const uint standing,
    global const uint2* parents, const uint writes, global uint2* blocks)
{
    OPEN_SINK
    local uint tests[GROUP_SIZE], below[GROUP_SIZE], pruned[GROUP_SIZE];
    volatile global uint* next_count = counters + FRONT_COUNT;
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint item = (uint)get_local_id(0);
    uint descents = 0u, prunes = 0u;
    tests[item] = 0u;
    if (get_global_id(0) < standing)
        tests[item] = advance_entry(FOREST, ropes, faces, parents, SINK, ENTRIES,
                                    front[get_global_id(0)], &descents, &prunes);
    below[item] = descents;
    pruned[item] = prunes;
    barrier(CLK_LOCAL_MEM_FENCE);
    count_tests(tests, counters);
    add_all(below, counters + DESCENTS_COUNT);
    add_all(pruned, counters + PRUNES_COUNT);
    close_sink(SINK);
    (void)blocks;
}

/// Walks from the roots, with `leaves_of_all` leaves, and writes the first front to `next`.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void generate(
    FOREST_PARAMETERS, global const uint* ropes, global const Face* faces, global uint2* pairs,
    const uint capacity, volatile global uint* counters, global uint2* next, const uint next_room,
    volatile global uint* bin_counts, const uint leaves_of_all, const uint object_count,
    const uint within, const uint between, global uint2* blocks)
{
    OPEN_SINK
    local uint tests[GROUP_SIZE];
    volatile global uint* next_count = counters + FRONT_COUNT;
    const uint writes = 1u, item = (uint)get_local_id(0);
    barrier(CLK_LOCAL_MEM_FENCE);
    tests[item] = 0u;
    if (get_global_id(0) < (ulong)leaves_of_all * object_count)
        tests[item] = generate_item(FOREST, ropes, faces, SINK, ENTRIES, object_count, within,
                                    between, get_global_id(0));
    barrier(CLK_LOCAL_MEM_FENCE);
    count_tests(tests, counters);
    close_sink(SINK);
    (void)blocks;
}
