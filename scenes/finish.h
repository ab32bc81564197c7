// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/scene.h"

namespace bvhbench {

/// Makes a Scene valid or refuses it: negative zeros become positive, `content_hash` is set, and a scene
/// without objects gets one over all faces. `name` and `source` must be set.
///
/// Throws Unavailable, in one sentence, when the scene has no triangles or frames, an index is out of
/// range, a position is not finite, or the objects do not cover the faces in order.
Scene finished(Scene scene);

}  // namespace bvhbench
