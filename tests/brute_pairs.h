// SPDX-License-Identifier: MIT
#pragma once

#include "collide/pairs.h"
#include "geometry/aabb.h"

namespace bvhbench {

/// Returns the pairs of boxes that overlap, by comparing every two of them.
inline std::vector<Pair> brute_pairs(std::span<const Aabb> boxes)
{
    std::vector<Pair> found;
    for (uint a = 0; a < boxes.size(); ++a)
        for (uint b = a + 1; b < boxes.size(); ++b)
            if (boxes[a].min_x <= boxes[b].max_x && boxes[b].min_x <= boxes[a].max_x &&
                boxes[a].min_y <= boxes[b].max_y && boxes[b].min_y <= boxes[a].max_y &&
                boxes[a].min_z <= boxes[b].max_z && boxes[b].min_z <= boxes[a].max_z)
                found.push_back({a, b});
    return found;
}

}  // namespace bvhbench
