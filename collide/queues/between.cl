// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DGROUP_SIZE=64u -DTASK_LEAVES=64u -DSKIP_APART=1 -DSKIP_OVERLAP=1
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DGROUP_SIZE=64u -DTASK_LEAVES=64u -DSKIP_APART=0 -DSKIP_OVERLAP=0
//
// Finds the tasks between objects: chunks of leaves of the object with more leaves, against each object whose box overlaps the
// box of the chunk. That box is the box of the subtree over the leaves, Eq. (13); in a tree with pointers it is the box of the
// whole object. SKIP_OVERLAP and SKIP_APART: drop tasks by the test of the chunk's box and of the object's box (skips.h).
#include "collide/found.clh"
#include "collide/walks/task.clh"
#include "geometry/bits.h"

static inline Aabb task_box(FOREST_PARAMETERS, const QueryTask task)
{
#if TREE_IMPLICIT
    PICK_TREE(task.own)
    const uint levels = divided_up(floor_log2(TASK_LEAVES), TREE_CHILD_BITS);
    return tree_box(TREE, tree_ancestor(TREE, tree_leaf(TREE, task.first), levels));
#else
    return root_box(FOREST, task.own);
#endif
}

/// True if the leaves of object a query the tree of object b rather than the other way round. Many short walks end sooner than a few
/// long ones: a ball's 760 leaves against a cloth's 91,470 took 7 times as long as the cloth's leaves against the ball.
static inline bool asks(const uint a_leaves, const uint b_leaves, const bool comes_first)
{
    return a_leaves > b_leaves || (a_leaves == b_leaves && comes_first);
}

/// Adds the tasks of a chunk of leaves against `count` objects from `first` on, whose boxes and numbers of leaves are in local memory.
/// Returns the number of tests. Tasks beyond the capacity of `between` are counted, not written.
static inline uint add_tasks(FOREST_PARAMETERS, QueryTask task, const uint first, const uint count,
                             local const Aabb* root_boxes, local const uint* leaf_counts,
                             global QueryTask* between, const uint most_between,
                             volatile global uint* counters)
{
    const ForestObject own = objects[task.own];
    const Aabb box = task_box(FOREST, task);
    const Aabb whole = root_box(FOREST, task.own);
    uint tests = 0u;
    for (uint k = 0u; k < count; ++k) {
        task.other = first + k;
        if (task.other == task.own || !asks(own.leaves, leaf_counts[k], task.own < task.other))
            continue;
        ++tests;
        if (SKIP_OVERLAP && !overlap(box, root_boxes[k]))
            continue;
        if (SKIP_APART && !overlap(whole, root_boxes[k]))
            continue;
        const uint slot = add_wide(counters + TASKS_COUNT, 1ul);
        if (slot < most_between)
            between[slot] = task;
    }
    return tests;
}

/// `chunks` are runs of neighbouring leaves of all objects. A group takes GROUP_SIZE chunks and OTHERS_AT_A_TIME objects at a time.
__attribute__((reqd_work_group_size(GROUP_SIZE, 1, 1))) kernel void find_between(
    FOREST_PARAMETERS, global const QueryTask* chunks, const uint chunk_count,
    const uint object_count, global QueryTask* between, const uint most_between,
    volatile global uint* counters)
{
    local Aabb root_boxes[OTHERS_AT_A_TIME];
    local uint leaf_counts[OTHERS_AT_A_TIME];
    local ulong group_tests[GROUP_SIZE];
    const uint item = (uint)get_local_id(0);
    const uint columns = divided_up(object_count, OTHERS_AT_A_TIME);
    const uint tiles = divided_up(chunk_count, GROUP_SIZE) * columns;
    ulong tests = 0ul;
    for (uint tile = (uint)get_group_id(0); tile < tiles; tile += (uint)get_num_groups(0)) {
        const uint first = tile % columns * OTHERS_AT_A_TIME;
        const uint count = min(OTHERS_AT_A_TIME, object_count - first);
        for (uint k = item; k < count; k += GROUP_SIZE) {
            root_boxes[k] = root_box(FOREST, first + k);
            leaf_counts[k] = objects[first + k].leaves;
        }
        barrier(CLK_LOCAL_MEM_FENCE);
        const uint chunk = tile / columns * GROUP_SIZE + item;
        if (chunk < chunk_count)
            tests += add_tasks(FOREST, chunks[chunk], first, count, root_boxes, leaf_counts,
                               between, most_between, counters);
        barrier(CLK_LOCAL_MEM_FENCE);  // they have been read
    }
    add_tests(group_tests, tests, counters + BOX_TESTS_COUNT);
}
