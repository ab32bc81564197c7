// SPDX-License-Identifier: MIT
//
// Boxes with room for a distance, on the host: those of the halo, and those that decide which triangles leave.
#pragma once

#include "geometry/aabb.h"

namespace bvhbench {

/// Returns the box with a reach to each side, as collide/within/pad.cl gives it to vertices.
Aabb padded(const Aabb& box, float reach);

/// Returns a box that overlaps every box that, when it is padded, overlaps `box`.
///
/// Proof, for an upper end h of `box`. Take a box that begins at a > h. Padded it begins at a - reach, less a rounding of at most
/// 2^-21 (|h| + reach) + 2^-119, moved into the range from -2^60 to 2^60. If that is at most h < 2^60, a is at most h + reach and the rounding,
/// and twice as much is added. An h from 2^60 on bounds nothing.
Aabb padded_again(const Aabb& box, float reach);

}  // namespace bvhbench
