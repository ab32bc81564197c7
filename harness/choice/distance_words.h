// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "geometry/aabb.h"

namespace bvhbench {

/// True if `word` is a distance that the options `within` and `separation` take: a number that is not negative, in the scene's unit, or
/// one with a %, of the diagonal of the scene's box.
bool is_distance(const std::string& word);

/// Returns the distance for a scene, nothing for "none". A number is the nearest double; a share is multiplied in doubles by the diagonal
/// of `around`, the box around the triangles of the scene's first frame, whichever frames are asked for.
std::optional<double> distance_of(const std::string& word, const Aabb& around);

}  // namespace bvhbench
