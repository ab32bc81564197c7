// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "collide/oracles/sweep.h"
#include "collide/pairs.h"

namespace bvhbench {

/// Calls meet(a, b) for objects whose boxes overlap, unless among == within_objects, and meet(a, a), unless between_objects.
template <class Object, class Meet>
void for_near_objects(const std::vector<std::unique_ptr<Object>>& objects,
                      std::span<const Aabb> boxes, Among among, const Meet& meet)
{
    if (among != Among::within_objects) {
        const PairList near = swept_pairs(boxes);
        for (const Pair pair : near.pairs())
            meet(*objects[pair.a], *objects[pair.b]);
    }
    if (among != Among::between_objects)
        for (const auto& object : objects)
            meet(*object, *object);
}

}  // namespace bvhbench
