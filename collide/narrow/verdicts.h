// SPDX-License-Identifier: MIT
//
// What a test says about a pair of triangles.
#ifndef BVHBENCH_COLLIDE_VERDICTS_H
#define BVHBENCH_COLLIDE_VERDICTS_H

#define VERDICT_APART 0u
#define VERDICT_MEET 1u
#define VERDICT_UNSURE 2u

// Beside a verdict that took doubles.
#define BY_DOUBLES 4u

#endif
