// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "builders/implicit/later_subtree.h"
#include "builders/implicit/schedule.h"
#include "device/arena.h"
#include "device/queue.h"
#include "geometry/forest.h"

namespace bvhbench {

/// One launch for all objects whose trees are high enough to take part in it.
struct Launch {
    uint first_subtree = 0, subtrees = 0;  ///< Range of the list; first round only if groups wait.
    std::int64_t moved_bytes = 0;
};

/// How launches are planned from the number of leaves of each tree.
struct LaunchPlan {
    std::span<const ForestObject>
        objects;  ///< All objects; if there are several, kernels look their subtrees up in a list.
    std::function<SubtreeSchedule(uint leaves)> schedule;
    std::function<std::int64_t(uint leaves, const SubtreeLaunch&)> moved_bytes;
    bool in_one_launch = false;  ///< The first launch builds up to the roots.
    /// Some of its groups wait for the roots that further launches would start from.
    bool waits = false;
};

/// The launches that build the trees of all or some objects.
struct Launches {
    std::vector<Launch> list;
    std::vector<cl_uint2> subtree_list;  ///< Object and position, launch by launch.
    Buffer<cl_uint2> subtrees;
    std::vector<LaterSubtree> later_list;  ///< If groups wait: subtrees of rounds after the first.
    Buffer<LaterSubtree> later;

    /// Plans the launches of the objects `chosen`.
    void plan(std::span<const uint> chosen, const LaunchPlan& how);

    /// Takes memory for the lists of `most`.
    void take(Arena& arena, const Launches& most);

    /// Uploads the lists. Blocks.
    void upload(const cl::CommandQueue& queue);
};

}  // namespace bvhbench
