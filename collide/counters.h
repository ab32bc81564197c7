// SPDX-License-Identifier: MIT
//
// Device counters of a query: 64-bit, two words each (collide/found.clh).
#ifndef BVHBENCH_COLLIDE_COUNTERS_H
#define BVHBENCH_COLLIDE_COUNTERS_H

#define PAIRS_COUNT 0u      // pairs found, including those beyond the buffer's capacity
#define BOX_TESTS_COUNT 2u  // boxes tested for overlap
#define TASKS_COUNT 4u      // leaf, group and block: tasks between objects
#define TASKS_BEGUN \
    6u  // chunk form of group and block: number of tasks that work-items have taken; one word
#define QUEUES_COUNT 6u  // bvtt: queue sizes, one per step

#define UNSURE_COUNT \
    6u  // leaf up to the first contact: pairs left to exact arithmetic; 0 if there is a contact

#define CHILDREN_COUNT 6u  // block over a tree that it collapses: children of wide nodes

// Counters of front and front-leaf, from QUEUES_COUNT on:
#define FRONT_COUNT 6u      // entries of the front that a frame writes
#define PRUNES_COUNT 8u     // entries that climbed to an ancestor
#define DESCENTS_COUNT 10u  // front-leaf: boxes tested below entries
#define FRONT_QUEUES_COUNT \
    8u  // front: sizes of the queues of steps 1, 2, ... follow 2 words further on; step 0 reads the front

#endif
