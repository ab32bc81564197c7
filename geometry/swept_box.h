// SPDX-License-Identifier: MIT
#ifndef BVHBENCH_GEOMETRY_SWEPT_BOX_H
#define BVHBENCH_GEOMETRY_SWEPT_BOX_H

#include "geometry/aabb.h"

SHARED_BEGIN

/// The box around a triangle on its way from one frame to the next, of its boxes in the two.
///
/// Vertices move in straight lines, p(t) = (1 - t) p0 + t p1 with t from 0 to 1. A coordinate of any point of the
/// triangle at any t is a mean of its corners' coordinates in both frames, with weights that are not negative and sum to
/// one; so it is between the smallest and the largest of these, which are sides of the two boxes. The smallest and largest
/// of floats are floats: nothing is rounded, and since boxes are closed two that touch on the way have boxes that overlap.
/// No smaller box will do, for the corners are where they are in both frames. Nor does it matter how a frame in between is
/// computed, if it is rounded to floats to nearest in the end, for rounding keeps the order of numbers.
SHARED_FN Aabb swept_box(Aabb first, Aabb last) { return merged(first, last); }

SHARED_END

#endif
