// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/scene.h"

namespace bvhbench {

/// The connected parts of a mesh as objects, in order of their first triangles; none if the triangles of
/// some part do not follow each other. Two triangles that name a common vertex are connected.
std::vector<SceneObject> connected_parts(const std::vector<Face>& faces, std::size_t vertices);

}  // namespace bvhbench
