// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "geometry/mesh.h"

namespace bvhbench {

/// One axis of a set of boxes.
struct Axis {
    float Aabb::*min;
    float Aabb::*max;
    double low = 0;     ///< smallest coordinate of all boxes
    double length = 0;  ///< extent of all boxes along the axis
    double share = 0;   ///< mean extent of a box, as a fraction of `length`
};

/// Returns the axes, ordered by the mean share of a box: the fewest boxes overlap, as a rule, along the first.
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
        if (!std::isfinite(axis.share))
            axis.share = std::numeric_limits<double>::infinity();
    }
    std::stable_sort(axes.begin(), axes.end(),
                     [](const Axis& a, const Axis& b) { return a.share < b.share; });
    return axes;
}

}  // namespace bvhbench
