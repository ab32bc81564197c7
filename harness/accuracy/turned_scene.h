// SPDX-License-Identifier: MIT
//
// Scenes whose vertices are doubles, as simulations have them: a scene of floats, turned by an angle and moved far off,
// with what comes of it computed in doubles and taken as given.
#pragma once

#include <span>
#include <vector>

#include "collide/pairs.h"
#include "geometry/mesh.h"
#include "scenes/doubles.h"

namespace bvhbench {

/// `points`, turned and then moved along all axes by `sizes` times the longest side of their box.
std::vector<WidePoint> turned_and_moved(std::span<const Point> points, double sizes);

/// Rounded to floats, as a file of them is.
std::vector<Point> rounded(const std::vector<WidePoint>& points, Doubles how);

/// The pairs of triangles whose boxes of doubles overlap: the reference. A sweep on one core.
PairList overlapping_pairs_in_doubles(std::span<const WidePoint> points,
                                      std::span<const Face> faces);

}  // namespace bvhbench
