// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "collide/collider.h"
#include "collide/oracles/sweep.h"
#include "collide/skips.h"

namespace bvhbench {

/// What a query of a library with one tree per object has to do.
struct ObjectTasks {
    std::vector<Pair>
        meetings;  ///< objects to test against each other; an object with itself is {k, k}
    std::vector<uint> with_trees;  ///< objects whose trees the query needs, ascending
};

/// Returns the meetings of objects with these boxes. Boxes of two objects that meet overlap. By the rule `near` (collide/skips.h)
/// objects that take part in no meeting need no tree.
inline ObjectTasks object_tasks(std::span<const Aabb> boxes, const ColliderOptions& options)
{
    ObjectTasks tasks;
    const auto count = static_cast<uint>(boxes.size());
    if (options.among != Among::within_objects) {
        const PairList near = swept_pairs(boxes);
        tasks.meetings.assign(near.pairs().begin(), near.pairs().end());
    }
    if (options.among != Among::between_objects)
        for (uint k = 0; k < count; ++k)
            tasks.meetings.push_back({k, k});
    std::vector<bool> is_needed(count, (options.rules_off & skip_near) != 0);
    for (const Pair pair : tasks.meetings)
        is_needed[pair.a] = is_needed[pair.b] = true;
    for (uint k = 0; k < count; ++k)
        if (is_needed[k])
            tasks.with_trees.push_back(k);
    return tasks;
}

}  // namespace bvhbench
