// SPDX-License-Identifier: MIT
//
// The sign of a sum of doubles, exactly, by passes that leave the sum what it is and make it easier to see.
//
// One pass adds the terms in a row. Of each addition it keeps the rounding error, which is a double itself, in place of
// the term, and behind all errors the sum as rounded:
//
//     terms     t0  t1  t2  ...  tn-1
//     errors        e1  e2  ...  en-1  s        their exact sum is that of the terms
//
// Where the errors together are less than s, its sign is the answer. Each pass makes the errors smaller than the last
// did by a factor of 2n u, u = 2^-53 [Ogita2005]. Terms made of floats are multiples of a least number, and so are
// errors; below it they are all zero. For the 48 terms of orient3d that is 2^46 a pass, from 2^390 down to 2^-447, and
// so never more than 19 passes; 2 or 3 are usual.
#ifndef BVHBENCH_GEOMETRY_EXACT_SUM_H
#define BVHBENCH_GEOMETRY_EXACT_SUM_H

#include "geometry/dialect.h"

#if HAS_DOUBLES
SHARED_BEGIN

#define MOST_TERMS 48u

/// What is to be added: the first so many.
typedef struct {
    double at[MOST_TERMS];
} Terms;

/// -1, 0 or 1. None of the partial sums may overflow, nor an error underflow.
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
        // Twice, since `errors` is itself rounded.
    } while (errors != 0.0 && fabs(sum) <= 2.0 * errors);
    return (sum > 0.0 ? 1 : 0) - (sum < 0.0 ? 1 : 0);
}

SHARED_END
#endif

#endif
