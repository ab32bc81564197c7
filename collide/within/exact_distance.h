// SPDX-License-Identifier: MIT
#pragma once

#include "collide/narrow/exact_contact.h"

namespace bvhbench {

/// True if two triangles that do not meet are within `distance` of each other: exactly, in integers. Touching distances count.
/// They are if one of the ways of features.h is that short.
bool parted_within(const Corners& a, const Corners& b, double distance);

}  // namespace bvhbench
