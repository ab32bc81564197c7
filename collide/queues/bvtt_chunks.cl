// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DSINK_BLOCK=512u -DONE_OBJECT=0 -DLABEL_BITS=20
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DSINK_BLOCK=512u -DONE_OBJECT=1 -DLABEL_BITS=32
//
// A step of the traversal, a work-item a run of neighbouring tasks, with a block for nodes and one for pairs.
#include "collide/sinks/sink_chunks.clh"

#define LISTS_PARAMETERS                                                                       \
    global uint2 *node_block, uint *node_count, global uint2 *next, const uint queue_capacity, \
        volatile global uint *next_size, SINK_PARAMETERS
#define LISTS_PASSED node_block, node_count, next, queue_capacity, next_size, SINK_PASSED

static inline void keep_node(LISTS_PARAMETERS, const uint2 pair)
{
    (void)block, (void)block_count, (void)out, (void)capacity, (void)out_count;
    put(node_block, node_count, next, queue_capacity, next_size, pair);
}

static inline void keep_pair(LISTS_PARAMETERS, const uint2 pair)
{
    (void)node_block, (void)node_count, (void)next, (void)queue_capacity, (void)next_size;
    put(SINK_PASSED, pair);
}

#include "collide/queues/bvtt.clh"

/// As in bvtt_groups.cl. `blocks` has 2 SINK_BLOCK pairs a work-item.
kernel void expand(FOREST_PARAMETERS, global const uint* ropes, global const Face* faces,
                   global uint2* pairs, const uint capacity, volatile global uint* counters,
                   global const uint2* queue, global uint2* next, const uint queue_capacity,
                   const uint step, const uint levels, global uint2* blocks)
{
    volatile global uint* sizes = counters + QUEUES_COUNT + 2u * step;
    const uint waiting = entries_of(sizes, queue_capacity, step);
    const ulong tasks = tasks_of(waiting, levels);
    const ulong share = (tasks + get_global_size(0) - 1ul) / get_global_size(0);
    const ulong first = min(tasks, get_global_id(0) * share), end = min(tasks, first + share);
    global uint2* node_block = blocks + SINK_BLOCK * (get_global_size(0) + get_global_id(0));
    uint node_count = 0u, block_count = 0u;
    ulong tests = 0ul;
    for (ulong task = first; task < end; ++task)
        tests += do_task(FOREST, faces, queue, step, levels, task, node_block, &node_count, next,
                         queue_capacity, sizes + 2, SINK);
    empty_block(node_block, &node_count, next, queue_capacity, sizes + 2);
    empty_block(SINK);
    add_wide(counters + BOX_TESTS_COUNT, tests);
    (void)ropes;
}
