// SPDX-License-Identifier: MIT
//
// Scenes derived from another scene. The caller calls `finished` on the results, except for `with_frames_between`.
#pragma once

#include "scenes/scene.h"

namespace bvhbench {

/// Returns `scene` with exactly `triangles` triangles. The longest edge (in the first frame) is cut at its middle, together
/// with every triangle at that edge, until there are enough triangles. The surface does not change. The last cut may split only
/// some of the triangles at an edge and then leaves a vertex on the edge of the others.
///
/// All frames are cut in the same way; objects stay contiguous. Throws BadUsage if the scene has more triangles.
Scene refined(Scene scene, uint triangles);

/// Returns `scene` with one triangle detached and moved by `diameters` times the diagonal of the scene's box, along the
/// triangle's normal (the paper's Fig. 12). All other triangles and the order of triangles are unchanged.
///
/// Every frame uses its own box and normal. The triangle gets three new vertices, so that its neighbours are not stretched.
/// Throws BadUsage if there is no such triangle or it has no normal.
Scene with_outlier(Scene scene, uint triangle, double diameters);

/// Returns `scene`, which has one frame, with a second frame in which it is bent: a smooth motion for scenes without motion.
///
/// With u, v, w the position of a point in the box of all points, each from 0 to 1, and b(t) = 4t(1 - t), the point moves by
/// b(v), b(w), b(u) along x, y, z, times 1/32 of the box's longest side. Computed in doubles with operations defined by IEEE
/// 754 only, hence the same on every machine. Throws BadUsage if the scene has more than one frame.
Scene with_bend(Scene scene);

/// Returns `scene` with `between` frames inserted after each frame but the last. Every vertex moves linearly from one frame to
/// the next: V(t) = (1 - t) V0 + t V1 at t = k / (between + 1), in doubles, rounded to float once. The original frames are
/// unchanged, bit for bit. The result is finished and keeps its name.
///
/// A rotating object also moves linearly and is slightly smaller in the inserted frames, so a rigid object is not rigid there.
/// Swept-volume tests of such data assume the same motion. Throws BadUsage if the scene has one frame and `between` is not 0,
/// Unavailable if there is not enough memory.
Scene with_frames_between(Scene scene, uint between);

}  // namespace bvhbench
