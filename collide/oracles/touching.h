// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

#include "collide/pairs.h"
#include "geometry/triangle.h"

namespace bvhbench {

/// Returns how many of `contacts`, pairs of triangles that intersect, only touch. Two triangles cross if corners of each lie strictly
/// on both sides of the other's plane and the two meet in more than a point; a triangle without area, which is a segment, crosses
/// another one if it passes through its inside. All other contacts only touch: those of triangles in one plane, and those at corners
/// and edges of one that the other does not pass. Exact; uses all host cores.
std::uint64_t only_touching(std::span<const Point> points, std::span<const Face> faces,
                            std::span<const Pair> contacts);

}  // namespace bvhbench
