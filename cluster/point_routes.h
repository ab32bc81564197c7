// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "cluster/share.h"

namespace bvhbench {

/// How points get from the ranks that have them, frame after frame, to the ranks whose triangles use them.
class PointRoutes {
public:
    PointRoutes() = default;

    /// `given`: the vertices, as numbered in the scene, of which this rank has the points. Each vertex of a share is given by some
    /// rank; if several give it, the lowest of them sends it. All ranks must call.
    PointRoutes(std::span<const uint> given, const Share& share, Ranks& ranks);

    /// Takes the points of the vertices given, and returns those of the share. All ranks must call.
    std::vector<Point> sent(std::span<const Point> points, Ranks& ranks) const;

private:
    std::size_t share_points_ = 0;
    std::vector<std::vector<uint>>
        leaving_;  ///< by the rank that they go to: places among the vertices given
    std::vector<std::vector<uint>>
        arriving_;  ///< by the rank that they come from: places among the share's points
};

}  // namespace bvhbench
