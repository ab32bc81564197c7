// SPDX-License-Identifier: MIT
//
// Scenes made of another one. The caller makes them `finished`, but for `with_frames_between`.
#pragma once

#include "scenes/scene.h"

namespace bvhbench {

/// `scene` with exactly `triangles` triangles: its longest edge (in the first frame) is cut in the middle,
/// and with it every triangle at that edge, until there are enough. The surface stays where it is. The last
/// cut may be of some of an edge's triangles only and then leaves a vertex on the edge of another.
///
/// All frames are cut alike; objects stay together. Throws BadUsage when the scene has more triangles.
Scene refined(Scene scene, uint triangles);

/// `scene` with one triangle cut loose and moved by `diameters` times the diagonal of the scene's box, along the
/// triangle's own normal (the paper's Fig. 12). The others stay where they are, and so does the order of all.
///
/// In every frame by that frame's box and normal. The triangle gets three vertices of its own, so that its
/// neighbours are not stretched. Throws BadUsage when there is no such triangle or it has no normal.
Scene with_outlier(Scene scene, uint triangle, double diameters);

/// `scene`, which has one frame, with a second one in which it is bent: what moves smoothly, for scenes that do
/// not move.
///
/// With u, v, w a point's place in the box of all points, each from 0 to 1, and b(t) = 4t(1 - t), the point moves
/// by b(v), b(w), b(u) along x, y, z, times 1/32 of the box's longest side. In double and without a function
/// that IEEE 754 does not fix, so the same on every machine.
/// Throws BadUsage when the scene has frames to move by.
Scene with_bend(Scene scene);

/// `scene` with `between` more frames after each but the last, every vertex on the straight way from one to the
/// next: V(t) = (1 - t) V0 + t V1 at t = k / (between + 1), in double, rounded to float once. The frames that
/// were there stay as they are, bit for bit. The scene is finished again; its name stays.
///
/// What turns goes straight too and is a little smaller between two frames than in them: a rigid object is not
/// rigid there. Swept-volume tests of such data assume the same motion.
/// Throws BadUsage when the scene has one frame and `between` is not 0, Unavailable when memory is too small.
Scene with_frames_between(Scene scene, uint between);

}  // namespace bvhbench
