// SPDX-License-Identifier: MIT
#pragma once

#include "collide/narrow/exact_contact.h"

namespace bvhbench {

/// True if two triangles that do not meet are within `distance` of each other: exactly, in integers. Touching distances count.
///
/// They are if two corners are, or a corner and its foot inside an edge or inside a face, or two edges at their common perpendicular;
/// what has no such foot or perpendicular, as a triangle without area, is as near as its parts are.
bool parted_within(const Corners& a, const Corners& b, double distance);

}  // namespace bvhbench
