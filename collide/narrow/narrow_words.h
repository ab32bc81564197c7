// SPDX-License-Identifier: MIT
//
// Verdicts of the narrow phase on a pair of triangles, indices of its 64-bit device counters (collide/found.clh), and tests for a distance
// (collide/within/within.cl).
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

#define WITHIN_CORNERS 1u   // certain by the way between two corners or by a plane, or unsure
#define WITHIN_WAYS 2u      // certain by any way, or unsure
#define WITHIN_COMPUTED 3u  // as computed
#define WITHIN_ROUNDED_BOXES 4u
#define WITHIN_SPHERES 5u
#define WITHIN_CAPSULES 6u
#define WITHIN_BOXES 7u  // all candidates

#endif
