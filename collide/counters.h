// SPDX-License-Identifier: MIT
//
// What a query counts on the device: 64-bit counts of two words each (collide/wide_count.clh).
#ifndef BVHBENCH_COLLIDE_COUNTERS_H
#define BVHBENCH_COLLIDE_COUNTERS_H

#define PAIRS_COUNT 0u      // pairs found, be there room for them or not
#define BOX_TESTS_COUNT 2u  // boxes tested for overlap
#define TASKS_COUNT 4u      // tasks between objects, and of bvtt the pairs of roots it starts with
#define QUEUES_COUNT 6u     // bvtt: entries of each step's queue

#endif
