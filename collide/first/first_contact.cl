// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=0 -DWITH_DOUBLES=1 -DGROUP_SIZE=64u
// check: -include oibvh/wide/wide8_access.clh -DSORTED_LEAVES=0 -DKEEP_ADJACENT=1 -DWITH_DOUBLES=1
// check: -include baselines/radix/access_apetrei.clh -DSORTED_LEAVES=1 -DKEEP_ADJACENT=1 -DWITH_DOUBLES=0 -Xclang -cl-ext=-cl_khr_fp64,-__opencl_c_fp64
//
// As walks/leaf_groups.cl and leaf_chunks.cl, but the query ends at the first contact: a pair is tested where it is found, and no leaf
// begins once one was found. Both forms have no barriers, so that each work-item may leave.
#include "builders/stages/chunk.clh"
#include "collide/first/flag.clh"
#include "collide/found.clh"
#include "collide/narrow/narrow_words.h"
#include "collide/narrow/verdict.clh"

/// The sink of walks/leaf.clh: what a pair is tested by, and where it goes.
typedef struct {
    global const Point* points;
    global const Face* faces;
    global uint2 *contact, *unsure;
    uint unsure_room;
    volatile global uint* counters;
} Tester;

#define SINK_PARAMETERS const Tester* sink
#define SINK sink

static inline void put(SINK_PARAMETERS, const uint2 pair)
{
    if (is_found(sink->counters))
        return;
    const Face first = sink->faces[pair.x], second = sink->faces[pair.y];
    uint verdict = first_verdict(sink->points, first, second);
    if (verdict == VERDICT_OPEN)
        verdict = second_verdict(sink->points, first, second);
    if ((verdict & VERDICT_MEET) != 0u)
        answer(sink->counters, sink->contact, pair);
    if ((verdict & VERDICT_UNSURE) == 0u)
        return;
    const uint slot = add_wide(sink->counters + UNSURE_COUNT, 1ul);
    if (slot < sink->unsure_room)
        sink->unsure[slot] = pair;
}

#include "collide/walks/leaf.clh"

/// `counters` are zero but for what between.cl added. If a pair surely meets, it is the only one of `pairs`. Else `unsure` receives
/// what fits of the pairs that decide.cl has to decide; all are counted.
#ifdef GROUP_SIZE
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1)))
#endif
kernel void
find_first(FOREST_PARAMETERS, global const uint* ropes, global const Face* faces,
           global uint2* pairs, const uint capacity, volatile global uint* counters,
           TASKS_PARAMETERS, global const Point* points, global uint2* unsure,
           const uint unsure_room)
{
    (void)capacity;
    const Tester tester = {points, faces, pairs, unsure, unsure_room, counters};
    const uint tasks = task_count(TASKS, counters);
#ifdef GROUP_SIZE
    const uint group = min((uint)get_group_id(0), tasks);
    const Chunk own = {group, min(group + 1u, tasks)};
    const uint lane = (uint)get_local_id(0), lanes = GROUP_SIZE;
#else
    const Chunk own = own_chunk(tasks);
    const uint lane = 0u, lanes = 1u;
#endif
    for (uint k = own.first; k < own.end; ++k) {
        // The last come first, which are between objects: that is where most contacts are.
        const QueryTask task = task_of(TASKS, counters, tasks - 1u - k);
        PICK_TREE(task.other)
        for (uint item = lane; item < task.count && !is_found(counters); item += lanes) {
            const uint place = task.first + item;
            const Aabb box = leaf_box_of(FOREST, task.own, place);
            const uint triangle = leaf_triangle_of(FOREST, task.own, place);
            walk_of(TREE, ropes, faces, &tester, box, triangle, task, place);
        }
    }
}
