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

/// Of an order that has codes, for the triangles of one object.
CodeCounts code_counts(const OrderEntry& order, std::span<const Point> points,
                       std::span<const Face> faces);

}  // namespace bvhbench
