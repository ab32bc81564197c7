// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DSINK_BLOCK=256u -DLABEL_BITS=20
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DSINK_BLOCK=256u -DLABEL_BITS=32
//
// A step of front tracking, a work-item a run of neighbouring tasks, with a block each for nodes that sprout, for
// entries of the front and for pairs.
#include "collide/sinks/sink_chunks.clh"

/// Where one kind of what is kept goes: a block, and behind it a list.
typedef struct {
    global uint2* block;
    uint filled;
    global uint2* out;
    uint capacity;
    volatile global uint* out_count;
} List;

typedef struct {
    List nodes, pairs, entries;
    ulong prunes;
} Lists;

#define LISTS_PARAMETERS Lists* lists
#define LISTS_PASSED lists
#define SINK_OF(list) (list).block, &(list).filled, (list).out, (list).capacity, (list).out_count

static inline void keep_node(LISTS_PARAMETERS, const uint2 pair)
{
    put(SINK_OF(lists->nodes), pair);
}

static inline void keep_pair(LISTS_PARAMETERS, const uint2 pair)
{
    put(SINK_OF(lists->pairs), pair);
}

static inline void keep_entry(LISTS_PARAMETERS, const uint2 pair)
{
    put(SINK_OF(lists->entries), pair);
}

static inline void count_prune(LISTS_PARAMETERS) { ++lists->prunes; }

#include "collide/front/front.clh"

/// As in front_groups.cl. `blocks` has 3 SINK_BLOCK pairs a work-item.
kernel void advance(FOREST_PARAMETERS, global const uint* ropes, global const Face* faces,
                    global uint2* pairs, const uint capacity, volatile global uint* counters,
                    global const uint2* parents, global const uint2* queue, global uint2* next,
                    const uint queue_capacity, global uint2* front, const uint front_capacity,
                    const uint step, const uint standing, const uint climbs, global uint2* blocks)
{
    const ulong tasks = tasks_of(counters, standing, queue_capacity, step);
    const ulong share = (tasks + get_global_size(0) - 1ul) / get_global_size(0);
    const ulong first = min(tasks, get_global_id(0) * share), end = min(tasks, first + share);
    global uint2* own = blocks + 3u * SINK_BLOCK * get_global_id(0);
    volatile global uint* next_count = counters + FRONT_QUEUES_COUNT + 2u * (step + 1u);
    Lists lists = {{own, 0u, next, queue_capacity, next_count},
                   {own + SINK_BLOCK, 0u, pairs, capacity, counters + PAIRS_COUNT},
                   {own + 2u * SINK_BLOCK, 0u, front, front_capacity, counters + FRONT_COUNT},
                   0ul};
    ulong tests = 0ul;
    for (ulong task = first; task < end; ++task)
        tests += do_task(FOREST, faces, parents, queue, step, climbs, task, &lists);
    empty_block(SINK_OF(lists.nodes));
    empty_block(SINK_OF(lists.pairs));
    empty_block(SINK_OF(lists.entries));
    add_wide(counters + BOX_TESTS_COUNT, tests);
    add_wide(counters + PRUNES_COUNT, lists.prunes);
    (void)ropes;
}
