// SPDX-License-Identifier: MIT
#pragma once

#include "collide/narrow/exact_contact.h"

namespace bvhbench {

/// The distance of two triangles, and a point of each that are that far apart. In the unit of the corners.
struct Closest {
    double distance;
    Vector a, b;
};

/// Returns the distance of two triangles, which may touch or intersect (distance 0: then `a` and `b` are one point of both) or be without
/// area, and points where it is reached; if these are several, any.
///
/// The distance is 0 only where they meet, and errs by less than 1e-10 of itself. The points lie in their triangles, and their difference
/// is as long as the distance, up to 2^-47 of the largest coordinate. Computed in doubles if the certificates of distance_filter.h show
/// that this is accurate, else in integers.
Closest closest_points(const Corners& p, const Corners& q);

}  // namespace bvhbench
