// SPDX-License-Identifier: MIT
#pragma once

#include "builders/orders.h"
#include "geometry/mesh.h"

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

}  // namespace bvhbench
