// SPDX-License-Identifier: MIT
//
// The narrow phase's words: what a test says about a pair of triangles, and what is counted on the device, 64-bit counts
// of two words each (collide/found.clh).
#ifndef BVHBENCH_COLLIDE_NARROW_WORDS_H
#define BVHBENCH_COLLIDE_NARROW_WORDS_H

#define VERDICT_APART 0u
#define VERDICT_MEET 1u
#define VERDICT_UNSURE 2u
#define BY_DOUBLES 4u  // beside a verdict that took doubles

#define CONTACTS_COUNT 0u       // pairs that intersect, be there room for them or not
#define NARROW_FLOAT_COUNT 2u   // candidates decided by their indices or in floats,
#define NARROW_DOUBLE_COUNT 4u  // in doubles,
#define NARROW_EXACT_COUNT 6u   // and neither, so that they wait for exact arithmetic
#define BATCHES_BEGUN 8u  // of the form for few cores: batches that work-items have taken; one word
#define NARROW_COUNTERS 10u

#endif
