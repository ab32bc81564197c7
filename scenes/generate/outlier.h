// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/scene.h"

namespace bvhbench {

/// `scene` with one triangle cut loose and moved by `diameters` times the diagonal of the scene's box, along the
/// triangle's own normal (the paper's Fig. 12). The others stay where they are, and so does the order of all.
///
/// In every frame by that frame's box and normal. The triangle gets three vertices of its own, so that its
/// neighbours are not stretched. Throws BadUsage when there is no such triangle or it has no normal.
/// The caller makes the result `finished`.
Scene with_outlier(Scene scene, uint triangle, double diameters);

}  // namespace bvhbench
