// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/scene.h"

namespace bvhbench {

/// `scene`, which has one frame, with a second one in which it is bent: what moves smoothly, for scenes that do
/// not move.
///
/// With u, v, w a point's place in the box of all points, each from 0 to 1, and b(t) = 4t(1 - t), the point moves
/// by b(v), b(w), b(u) along x, y, z, times 1/32 of the box's longest side. In double and without a function
/// that IEEE 754 does not fix, so the same on every machine.
/// Throws BadUsage when the scene has frames to move by. The caller makes the result `finished`.
Scene with_bend(Scene scene);

}  // namespace bvhbench
