// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/scene.h"

namespace bvhbench {

/// `scene` with `between` more frames after each but the last, every vertex on the straight way from one to the
/// next: V(t) = (1 - t) V0 + t V1 at t = k / (between + 1), in double, rounded to float once. The frames that
/// were there stay as they are, bit for bit. The scene is finished again; its name stays.
///
/// What turns goes straight too and is a little smaller between two frames than in them: a rigid object is not
/// rigid there. Swept-volume tests of such data assume the same motion.
/// Throws BadUsage when the scene has one frame and `between` is not 0, Unavailable when memory is too small.
Scene with_frames_between(Scene scene, uint between);

}  // namespace bvhbench
