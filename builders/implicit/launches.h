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

/// One launch, of all objects: those whose trees are so high take part in it.
struct Launch {
    uint first_subtree = 0, subtrees = 0;  ///< of the list; later ones are not among them
    std::int64_t moved_bytes = 0;
};

/// How a builder's launches are planned, by each tree's leaves.
struct LaunchPlan {
    std::span<const ForestObject>
        objects;  ///< all; of several, launches are listed for kernels to look up
    std::function<SubtreeSchedule(uint leaves)> schedule;
    std::function<std::int64_t(uint leaves, const SubtreeLaunch&)> moved_bytes;
    bool in_one_launch = false;  ///< the first launch goes on to the roots
    bool waits =
        false;  ///< and there are groups in it that wait for what later launches would start from
};

/// The launches that build the trees of all objects, or of some.
struct Launches {
    std::vector<Launch> list;
    std::vector<cl_uint2> subtree_list;  ///< object and position, launch by launch
    Buffer<cl_uint2> subtrees;
    std::vector<LaterSubtree> later_list;  ///< where groups wait: those of all but the first round
    Buffer<LaterSubtree> later;

    /// Those of some of the objects.
    void plan(std::span<const uint> chosen, const LaunchPlan& how);

    /// Take room for what `most` lists.
    void take(Arena& arena, const Launches& most);

    /// Waits.
    void upload(const cl::CommandQueue& queue);
};

}  // namespace bvhbench
