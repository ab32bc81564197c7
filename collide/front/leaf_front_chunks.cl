// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DSINK_BLOCK=256u -DLABEL_BITS=20 -DORDERED=0
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DSINK_BLOCK=256u -DLABEL_BITS=32 -DORDERED=1
//
// Front tracking in the chunk form: a work-item takes a contiguous run of entries, or of leaves, and has one block of output each
// for pairs and for entries.
#include "builders/stages/chunk.clh"
#include "collide/sinks/sink_chunks.clh"

#define ENTRIES_PARAMETERS List *entries, volatile global uint *bin_counts, const uint writes
#define ENTRIES entries, bin_counts, writes

static inline void put_entry(ENTRIES_PARAMETERS, const uint2 entry, const uint bin)
{
    if (writes == 0u)
        return;
    put(entries, entry);
#if ORDERED
    atomic_inc(bin_counts + bin);
#endif
    (void)bin, (void)bin_counts;
}

#include "collide/front/leaf_front.clh"

// Declares both lists of a work-item: its share of `blocks` has 2 SINK_BLOCK entries.
#define OPEN_LISTS                                                                        \
    global uint2* own_block = blocks + 2u * SINK_BLOCK * get_global_id(0);                \
    List found = {own_block, 0u, pairs, capacity, counters + PAIRS_COUNT};                \
    List written = {own_block + SINK_BLOCK, 0u, next, next_room, counters + FRONT_COUNT}; \
    List *const sink = &found, *const entries = &written;

/// As in leaf_front_groups.cl.
kernel void advance(FOREST_PARAMETERS, global const uint* ropes, global const Face* faces,
                    global uint2* pairs, const uint capacity, volatile global uint* counters,
                    global uint2* next, const uint next_room, volatile global uint* bin_counts,
                    global const uint2* front, const uint standing, global const uint2* parents,
                    const uint writes, global uint2* blocks)
{
    OPEN_LISTS
    const Chunk chunk = own_chunk(standing);
    ulong tests = 0ul, all_descents = 0ul;
    uint prunes = 0u;
    for (uint k = chunk.first; k < chunk.end; ++k) {
        uint descents = 0u;
        tests += advance_entry(FOREST, ropes, faces, parents, SINK, ENTRIES, front[k], &descents,
                               &prunes);
        all_descents += descents;
    }
    close_sink(sink);
    close_sink(entries);
    add_wide(counters + BOX_TESTS_COUNT, tests);
    add_wide(counters + DESCENTS_COUNT, all_descents);
    add_wide(counters + PRUNES_COUNT, prunes);
}

/// As in leaf_front_groups.cl.
kernel void generate(FOREST_PARAMETERS, global const uint* ropes, global const Face* faces,
                     global uint2* pairs, const uint capacity, volatile global uint* counters,
                     global uint2* next, const uint next_room, volatile global uint* bin_counts,
                     const uint leaves_of_all, const uint object_count, const uint within,
                     const uint between, global uint2* blocks)
{
    OPEN_LISTS
    const uint writes = 1u;
    const Chunk chunk = own_chunk(leaves_of_all);
    ulong tests = 0ul;
    for (uint k = chunk.first; k < chunk.end; ++k)
        for (uint object = 0u; object < object_count; ++object)
            tests += generate_item(FOREST, ropes, faces, SINK, ENTRIES, object_count, within,
                                   between, (ulong)k * object_count + object);
    close_sink(sink);
    close_sink(entries);
    add_wide(counters + BOX_TESTS_COUNT, tests);
}
