// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DTASK_LEAVES=64u -DSKIP_APART=1 -DSKIP_OVERLAP=1
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DTASK_LEAVES=64u -DSKIP_APART=0 -DSKIP_OVERLAP=0
//
// Finds the tasks between objects: chunks of leaves of the object with more leaves, against each object whose box overlaps the
// box of the chunk. That box is the box of the subtree over the leaves, Eq. (13); in a tree with pointers it is the box of the
// whole object. SKIP_OVERLAP and SKIP_APART: drop tasks by the test of the chunk's box and of the object's box (skips.h). A
// work-item tests its chunk against OTHERS_A_WORK_ITEM objects, one after the other.
#include "builders/stages/chunk.clh"
#include "collide/found.clh"
#include "collide/walks/task.clh"

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

/// True if the leaves of `a` query the tree of `b` rather than the other way round. Many short walks end sooner than a few long
/// ones: a ball's 760 leaves against a cloth's 91,470 took 7 times as long as the cloth's leaves against the ball.
static inline bool asks(const ForestObject a, const ForestObject b, const bool comes_first)
{
    return a.leaves > b.leaves || (a.leaves == b.leaves && comes_first);
}

/// `chunks` are runs of neighbouring leaves of all objects. Tasks beyond the capacity of `between` are counted, not written.
kernel void find_between(FOREST_PARAMETERS, global const QueryTask* chunks, const uint chunk_count,
                         const uint object_count, global QueryTask* between,
                         const uint most_between, volatile global uint* counters)
{
    const uint blocks = divided_up(object_count, OTHERS_A_WORK_ITEM);
    const Chunk part = own_chunk(chunk_count * blocks);
    ulong tests = 0ul;
    for (uint k = part.first; k < part.end; ++k) {
        QueryTask task = chunks[k / blocks];
        const ForestObject own = objects[task.own];
        const Aabb box __attribute__((unused)) = task_box(FOREST, task);
        const Aabb whole __attribute__((unused)) = root_box(FOREST, task.own);
        const uint first = k % blocks * OTHERS_A_WORK_ITEM;
        const uint end = min(object_count, first + OTHERS_A_WORK_ITEM);
        for (uint other = first; other < end; ++other) {
            if (other == task.own || !asks(own, objects[other], task.own < other))
                continue;
            ++tests;
            const Aabb others __attribute__((unused)) = root_box(FOREST, other);
#if SKIP_OVERLAP
            if (!overlap(box, others))
                continue;
#endif
#if SKIP_APART
            if (!overlap(whole, others))
                continue;
#endif
            const uint slot = add_wide(counters + TASKS_COUNT, 1ul);
            task.other = other;
            if (slot < most_between)
                between[slot] = task;
        }
    }
    add_wide(counters + BOX_TESTS_COUNT, tests);
}
