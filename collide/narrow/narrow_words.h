// SPDX-License-Identifier: MIT
//
// Verdicts of the narrow phase on a pair of triangles, and indices of its 64-bit device counters (collide/found.clh).
#ifndef BVHBENCH_COLLIDE_NARROW_WORDS_H
#define BVHBENCH_COLLIDE_NARROW_WORDS_H

#define VERDICT_APART 0u
#define VERDICT_MEET 1u
#define VERDICT_UNSURE 2u
#define BY_DOUBLES 4u    // added to a verdict that needed doubles
#define VERDICT_OPEN 8u  // not decided yet

#define CONTACTS_COUNT 0u      // pairs that intersect, including those beyond the buffer's capacity
#define NARROW_FLOAT_COUNT 2u  // candidates decided by their indices or in floats
#define NARROW_DOUBLE_COUNT 4u  // candidates decided in doubles
#define NARROW_EXACT_COUNT 6u   // candidates left to exact arithmetic
#define BATCHES_BEGUN 8u        // chunk form: batches taken so far; one word
#define NARROW_COUNTERS 10u

#endif
