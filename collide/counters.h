// SPDX-License-Identifier: MIT
//
// What a query counts on the device: 64-bit counts of two words each (collide/found.clh).
#ifndef BVHBENCH_COLLIDE_COUNTERS_H
#define BVHBENCH_COLLIDE_COUNTERS_H

#define PAIRS_COUNT 0u      // pairs found, be there room for them or not
#define BOX_TESTS_COUNT 2u  // boxes tested for overlap
#define TASKS_COUNT 4u      // tasks between objects, of leaf and group
#define TASKS_BEGUN \
    6u  // of group and block on few cores: tasks that work-items have taken; one word
#define QUEUES_COUNT 6u  // bvtt: entries of each step's queue

// Of front, from QUEUES_COUNT on:
#define FRONT_COUNT 6u   // entries of the front that a frame leaves
#define PRUNES_COUNT 8u  // entries that climbed to an ancestor
#define FRONT_QUEUES_COUNT \
    8u  // from 2 behind it on: entries of each step's queue but the first's, the front itself

#endif
