// SPDX-License-Identifier: MIT
//
// What axes know of their inputs on the host.
#pragma once

#include <span>
#include <vector>

#include "builders/orders.h"
#include "collide/pairs.h"
#include "geometry/mesh.h"
#include "scenes/doubles.h"

namespace bvhbench {

/// What codes do not tell apart.
struct CodeCounts {
    std::size_t duplicates = 0;   ///< triangles whose code one before them has
    std::size_t longest_run = 0;  ///< triangles with one code, most
};

/// Of an order that has codes, over objects that together are all faces, each on a grid of its own or all on one. Codes
/// are told apart within an object, by the bits that the number of objects leaves of them.
CodeCounts code_counts(const OrderEntry& order, std::span<const Point> points,
                       std::span<const Face> faces, std::span<const FaceRange> objects,
                       GridOver grid = GridOver::object);

/// A scene of doubles, as simulations have them: `points`, turned by an angle and then moved along all axes by `sizes`
/// times the longest side of their box, computed in doubles and taken as given.
std::vector<WidePoint> turned_and_moved(std::span<const Point> points, double sizes);

/// Rounded to floats, as a file of them is.
std::vector<Point> rounded(const std::vector<WidePoint>& points, Doubles how);

/// The pairs of triangles whose boxes of doubles overlap: the reference. Throws Unavailable for 2^24 points and more.
PairList overlapping_pairs_in_doubles(std::span<const WidePoint> points,
                                      std::span<const Face> faces);

}  // namespace bvhbench
