// SPDX-License-Identifier: MIT
//
// Exact sign of a sum of doubles, by passes that keep the exact sum and shrink the rounding errors in it.
//
// One pass adds the terms in order. The rounding error of each addition is itself a double and replaces the term; the rounded
// sum is stored after all errors:
//
//     terms     t0  t1  t2  ...  tn-1
//     errors        e1  e2  ...  en-1  s        their exact sum is that of the terms
//
// If the absolute errors together are less than |s|, the sign of s is the result. Each pass reduces the errors by a factor of
// 2n u, u = 2^-53 [Ogita2005]. Terms made from floats are multiples of a smallest number, and so are the errors: errors below
// it are zero. For the 48 terms of orient3d the factor is 2^46 per pass, from 2^390 down to 2^-447, hence at most 19 passes; 2
// or 3 are usual.
#ifndef BVHBENCH_GEOMETRY_EXACT_SUM_H
#define BVHBENCH_GEOMETRY_EXACT_SUM_H

#include "geometry/dialect.h"

#if HAS_DOUBLES
SHARED_BEGIN

#define MOST_TERMS 48u

/// Terms of a sum. The first `count` are used.
typedef struct {
    double at[MOST_TERMS];
} Terms;

/// Returns the sign of the exact sum: -1, 0 or 1. No partial sum may overflow, and no error may underflow.
SHARED_FN int sign_of_sum(Terms terms, uint count)
{
    double sum = 0.0, errors = 0.0;
    do {
        sum = terms.at[0];
        errors = 0.0;
        for (uint k = 1u; k < count; ++k) {
            const double term = terms.at[k];
            const double next = sum + term;
            const double added = next - sum;
            const double error = (sum - (next - added)) + (term - added);
            terms.at[k - 1u] = error;
            errors += fabs(error);
            sum = next;
        }
        terms.at[count - 1u] = sum;
        // The factor 2 covers the rounding of `errors` itself.
    } while (errors != 0.0 && fabs(sum) <= 2.0 * errors);
    return (sum > 0.0 ? 1 : 0) - (sum < 0.0 ? 1 : 0);
}

SHARED_END
#endif

#endif
