// SPDX-License-Identifier: MIT
//
// Tests of pairs of triangles for a distance (within.cl).
#ifndef BVHBENCH_COLLIDE_WITHIN_WORDS_H
#define BVHBENCH_COLLIDE_WITHIN_WORDS_H

#define WITHIN_CORNERS 1u   // certain by the way between two corners, or unsure
#define WITHIN_WAYS 2u      // certain by any way, or unsure
#define WITHIN_COMPUTED 3u  // as computed
#define WITHIN_ROUNDED_BOXES 4u
#define WITHIN_SPHERES 5u
#define WITHIN_CAPSULES 6u
#define WITHIN_BOXES 7u  // all candidates

#endif
