// SPDX-License-Identifier: MIT
//
// Box centres for top-down builders: bounds of a set of centres, and partition of a set along an axis.
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

/// Bounds of a set of centres, by axis. Doubles, because the extent between two floats may exceed the range of a float.
struct CentreBounds {
    std::array<double, 3> low;
    std::array<double, 3> high;

    double extent(std::size_t axis) const { return high[axis] - low[axis]; }

    /// Returns the axis of the largest extent, the first one if several are equal.
    std::size_t longest_axis() const
    {
        std::size_t longest = 0;
        for (std::size_t axis = 1; axis < 3; ++axis)
            if (extent(axis) > extent(longest))
                longest = axis;
        return longest;
    }
};

/// Returns the bounds of the centres of `ids`, which must not be empty.
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

/// Partitions `ids` so that its first `left` entries are the lowest along the longest axis of their centres. Ties are broken by
/// id, so the two sets are the same on every machine and have the given sizes for every input.
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
