// SPDX-License-Identifier: MIT
//
// Host-side properties and references of the axes' inputs.
#pragma once

#include <span>
#include <vector>

#include "builders/orders.h"
#include "collide/pairs.h"
#include "geometry/mesh.h"
#include "scenes/doubles.h"

namespace bvhbench {

/// Counts of triangles with equal codes.
struct CodeCounts {
    std::size_t duplicates = 0;   ///< triangles whose code an earlier triangle has
    std::size_t longest_run = 0;  ///< most triangles with one code
};

/// Counts equal codes of an order that has codes. `objects` cover all faces; each has its own grid, or all share one. Codes are
/// compared within an object, by the bits that remain beside the object's number.
CodeCounts code_counts(const OrderEntry& order, std::span<const Point> points,
                       std::span<const Face> faces, std::span<const FaceRange> objects,
                       GridOver grid = GridOver::object);

/// Returns a scene in doubles, like those of simulations: `points` rotated, then moved along all axes by `sizes` times the
/// longest side of their bounding box, computed in double.
std::vector<WidePoint> turned_and_moved(std::span<const Point> points, double sizes);

/// Returns the points rounded to floats, as a file of floats stores them.
std::vector<Point> rounded(const std::vector<WidePoint>& points, Doubles how);

/// Returns the reference: the pairs of triangles whose boxes in double overlap. Throws Unavailable for 2^24 points or more.
PairList overlapping_pairs_in_doubles(std::span<const WidePoint> points,
                                      std::span<const Face> faces);

}  // namespace bvhbench
