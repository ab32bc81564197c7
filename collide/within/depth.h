// SPDX-License-Identifier: MIT
#pragma once

#include "collide/narrow/exact_contact.h"

namespace bvhbench {

/// Returns the penetration depth of two triangles that meet, as a vector: the shortest translation of `b` after which they do not meet,
/// or only touch, in the unit of the corners. Zero, but for rounding, if they only touch or are in one plane.
///
/// The differences of points of both are a convex set, whose faces are perpendicular to a normal or to an edge of each: the shortest of the
/// translations along these 11 directions. In doubles; every direction is one to part along, so that rounding makes the depth too small by
/// no more than 2^-48 of the triangles' size.
Vector shortest_way_apart(const Corners& a, const Corners& b);

}  // namespace bvhbench
