// SPDX-License-Identifier: MIT
// check: -include oibvh/access.clh -DSORTED_LEAVES=0 -DLABEL_BITS=20 -DSKIP_APART=1 -DOTHERS=16u
// check: -include baselines/radix/access.clh -DSORTED_LEAVES=1 -DLABEL_BITS=32 -DSKIP_APART=0 -DOTHERS=16u
//
// What a simultaneous traversal of several objects begins with: each root with itself, untested, if pairs within
// objects are wanted, and the roots of two objects whose boxes overlap, if pairs between them are; without SKIP_APART
// (skips.h) of all two objects.
#include "collide/counters.h"
#include "collide/walks/node_word.clh"
#include "collide/wide_count.clh"

static inline void push(global uint2* queue, const uint capacity, volatile global uint* counters,
                        const uint2 entry)
{
    const uint slot = add_wide(counters + QUEUES_COUNT, 1ul);
    if (slot < capacity)
        queue[slot] = entry;
}

static inline Aabb root_of(FOREST_PARAMETERS, const uint object, uint* word, bool* is_leaf)
{
    PICK_TREE(object)
    const uint root = tree_root(TREE);
    *word = word_of(object, root);
    *is_leaf = tree_is_leaf(TREE, root);
    return tree_box(TREE, root);
}

kernel void find_roots(FOREST_PARAMETERS, const uint object_count, const uint within,
                       const uint between, global uint2* queue, const uint capacity,
                       volatile global uint* counters)
{
    const uint blocks = (object_count + OTHERS - 1u) / OTHERS;
    const uint own = (uint)get_global_id(0) / blocks;
    const uint first = (uint)get_global_id(0) % blocks * OTHERS;
    if (own >= object_count)
        return;
    uint word, other_word, tests = 0u;
    bool is_leaf, other_is_leaf;
    const Aabb box = root_of(FOREST, own, &word, &is_leaf);
    if (within != 0u && first == 0u && !is_leaf)
        push(queue, capacity, counters, (uint2)(word, word));
    const uint end = between != 0u ? min(object_count, first + OTHERS) : 0u;
    for (uint other = max(first, own + 1u); other < end; ++other) {
        ++tests;
        const Aabb others = root_of(FOREST, other, &other_word, &other_is_leaf);
        if (!SKIP_APART || overlap(box, others))
            push(queue, capacity, counters, (uint2)(word, other_word));
    }
    add_wide(counters + BOX_TESTS_COUNT, tests);
}
