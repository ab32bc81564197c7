// SPDX-License-Identifier: MIT
//
// What top-down builders ask of the centres of boxes: how far a few of them reach, and halves along an axis.
#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "geometry/scene_bounds.h"

namespace bvhbench {

/// A box centre by axis.
using Centre = std::array<float, 3>;

inline Centre centre_of(Aabb box)
{
    const Point centre = box_centre(box);
    return {centre.x, centre.y, centre.z};
}

/// From where to where some centres lie along each axis. Doubles: the extent of floats may exceed a float.
struct CentreBounds {
    std::array<double, 3> low;
    std::array<double, 3> high;

    double extent(std::size_t axis) const { return high[axis] - low[axis]; }

    /// The first of the longest.
    std::size_t longest_axis() const
    {
        std::size_t longest = 0;
        for (std::size_t axis = 1; axis < 3; ++axis)
            if (extent(axis) > extent(longest))
                longest = axis;
        return longest;
    }
};

/// The bounds of the centres of `ids`, of which there is at least one.
inline CentreBounds centre_bounds(std::span<const uint> ids, std::span<const Centre> centres)
{
    CentreBounds bounds{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        float low = centres[ids.front()][axis];
        float high = low;
        for (const uint id : ids) {
            low = std::min(low, centres[id][axis]);
            high = std::max(high, centres[id][axis]);
        }
        bounds.low[axis] = low;
        bounds.high[axis] = high;
    }
    return bounds;
}

/// Rearrange `ids` so that the `left` first are those that come first along the longest axis. Equal centres
/// go by id, so the two sets are the same on every machine and no input makes one side empty.
inline void split_at(std::span<uint> ids, std::span<const Centre> centres, std::size_t left)
{
    const std::size_t axis = centre_bounds(ids, centres).longest_axis();
    std::nth_element(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(left), ids.end(),
                     [&](uint a, uint b) {
                         const float at_a = centres[a][axis];
                         const float at_b = centres[b][axis];
                         return at_a != at_b ? at_a < at_b : a < b;
                     });
}

}  // namespace bvhbench
