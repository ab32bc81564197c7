// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "geometry/mesh.h"

namespace bvhbench {

/// One axis of a set of boxes.
struct Axis {
    float Aabb::*min;
    float Aabb::*max;
    double low = 0;              ///< smallest coordinate of all boxes
    double length = 0;           ///< extent of all boxes along the axis
    double share = 0;            ///< mean extent of a box, as a fraction of `length`
    std::uint64_t overlaps = 0;  ///< pairs of some boxes that overlap along the axis
};

/// Returns how many pairs of some boxes, evenly taken from all, overlap along an axis. The mean share does not tell: boxes without
/// an extent along an axis can all be in one place.
inline std::uint64_t overlaps_along(const Axis& axis, std::span<const Aabb> boxes)
{
    constexpr std::size_t most = 4096;
    std::vector<float> begins, ends;
    for (std::size_t k = 0; k < boxes.size(); k += boxes.size() / most + 1)
        if (boxes[k].*axis.min <= boxes[k].*axis.max) {  // not a NaN
            begins.push_back(boxes[k].*axis.min);
            ends.push_back(boxes[k].*axis.max);
        }
    std::ranges::sort(begins);
    std::ranges::sort(ends);
    std::uint64_t overlaps = 0;
    std::size_t ended = 0;
    for (std::size_t begun = 0; begun < begins.size(); ++begun) {
        while (ends[ended] < begins[begun])
            ++ended;
        overlaps += begun - ended;
    }
    return overlaps;
}

/// Returns the axes, ordered by how many boxes overlap along them: the fewest along the first.
inline std::array<Axis, 3> axes_of(std::span<const Aabb> boxes)
{
    Aabb all = empty_box();
    for (const Aabb& box : boxes)
        all = merged(all, box);
    std::array<Axis, 3> axes = {
        {{&Aabb::min_x, &Aabb::max_x}, {&Aabb::min_y, &Aabb::max_y}, {&Aabb::min_z, &Aabb::max_z}}};
    for (Axis& axis : axes) {
        double sum = 0;
        for (const Aabb& box : boxes)
            sum += static_cast<double>(box.*axis.max) - static_cast<double>(box.*axis.min);
        axis.low = all.*axis.min;
        axis.length = static_cast<double>(all.*axis.max) - axis.low;
        axis.share = sum / static_cast<double>(boxes.size()) / axis.length;
        axis.overlaps = overlaps_along(axis, boxes);
        if (!std::isfinite(
                axis.share)) {  // a NaN, an infinite box or no length: nothing can be cut or swept here
            axis.share = std::numeric_limits<double>::infinity();
            axis.overlaps = std::numeric_limits<std::uint64_t>::max();
        }
    }
    std::stable_sort(axes.begin(), axes.end(), [](const Axis& a, const Axis& b) {
        return std::pair(a.overlaps, a.share) < std::pair(b.overlaps, b.share);
    });
    return axes;
}

}  // namespace bvhbench
