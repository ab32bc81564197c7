// SPDX-License-Identifier: MIT
#ifndef BVHBENCH_GEOMETRY_SWEPT_BOX_H
#define BVHBENCH_GEOMETRY_SWEPT_BOX_H

#include "geometry/aabb.h"

SHARED_BEGIN

/// Returns the box around a triangle's motion from one frame to the next, given its boxes in the two frames.
///
/// Vertices move linearly, p(t) = (1 - t) p0 + t p1 with t from 0 to 1. At any t, a coordinate of any point of the triangle is
/// a mean of its corners' coordinates in both frames, with non-negative weights that sum to one. It therefore lies between the
/// smallest and the largest of these, which are sides of the two boxes. The minimum and maximum of floats are floats, so
/// nothing is rounded; since boxes are closed, two triangles that touch during the motion have boxes that overlap. No smaller
/// box suffices, because the corners are in it in both frames. The way in which a frame in between is computed does not matter
/// if the result is rounded to the nearest floats, because rounding keeps the order of numbers.
SHARED_FN Aabb swept_box(Aabb first, Aabb last) { return merged(first, last); }

SHARED_END

#endif
