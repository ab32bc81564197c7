// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/scene.h"

namespace bvhbench {

/// `scene` with exactly `triangles` triangles: its longest edge (in the first frame) is cut in the middle,
/// and with it every triangle at that edge, until there are enough. The surface stays where it is. The last
/// cut may be of some of an edge's triangles only and then leaves a vertex on the edge of another.
///
/// All frames are cut alike; objects stay together. Throws BadUsage when the scene has more triangles.
/// The caller makes the result `finished`.
Scene refined(Scene scene, uint triangles);

}  // namespace bvhbench
