// SPDX-License-Identifier: MIT
#pragma once

#include <array>

namespace bvhbench {

/// A position in doubles, on the host and on the device.
struct WidePoint {
    double x = 0, y = 0, z = 0;
};
static_assert(sizeof(WidePoint) == 3 * sizeof(double));

/// A query of continuous collision detection: four points, each of which moves in a straight line from time 0 to 1. They are the ends of
/// the edges 0 1 and 2 3, or vertex 0 and the corners 1 2 3 of a face.
struct MovingQuery {
    std::array<WidePoint, 4> from, to;
    bool of_edges = false;
};

}  // namespace bvhbench
