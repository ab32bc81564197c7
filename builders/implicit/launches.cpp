// SPDX-License-Identifier: MIT
#include "builders/implicit/launches.h"

#include <algorithm>

namespace bvhbench {
namespace {

/// Returns the subtrees of all rounds but the first, by round, then by object.
std::vector<LaterSubtree> later_subtrees(std::span<const uint> objects,
                                         std::span<const SubtreeSchedule> schedules)
{
    std::vector<LaterSubtree> list;
    std::vector<uint> below;  // per object, the first root of the previous round
    uint next = 0;
    for (const SubtreeSchedule& schedule : schedules) {
        below.push_back(next);
        next += schedule.count > 0 ? schedule.launches[0].subtrees : 0;
    }
    for (uint round = 1; round < SubtreeSchedule{}.launches.size(); ++round)
        for (std::size_t chosen = 0; chosen < objects.size(); ++chosen) {
            if (round >= schedules[chosen].count)
                continue;
            const uint subtrees = schedules[chosen].launches[round].subtrees;
            for (uint position = 0; position < subtrees; ++position)
                list.push_back({below[chosen], round, position, objects[chosen]});
            below[chosen] = next;
            next += subtrees;
        }
    return list;
}

}  // namespace

void Launches::plan(std::span<const uint> chosen, const LaunchPlan& how)
{
    list.clear();
    subtree_list.clear();
    std::vector<SubtreeSchedule> schedules;
    uint count = 0;
    for (const uint object : chosen) {
        schedules.push_back(how.schedule(how.objects[object].leaves));
        count = std::max(count, schedules.back().count);
    }
    for (uint k = 0; k < (how.in_one_launch ? std::min(count, 1u) : count); ++k) {
        Launch launch{static_cast<uint>(subtree_list.size()), 0, 0};
        for (std::size_t which = 0; which < chosen.size(); ++which) {
            if (k >= schedules[which].count)
                continue;
            const SubtreeLaunch& part = schedules[which].launches[k];
            launch.subtrees += part.subtrees;
            launch.moved_bytes += how.moved_bytes(how.objects[chosen[which]].leaves, part);
            for (uint position = 0; how.objects.size() > 1 && position < part.subtrees; ++position)
                subtree_list.push_back({{chosen[which], position}});
        }
        list.push_back(launch);
    }
    later_list = how.waits ? later_subtrees(chosen, schedules) : std::vector<LaterSubtree>{};
}

void Launches::take(Arena& arena, const Launches& most)
{
    subtrees = arena.take<cl_uint2>(most.subtree_list.size(), Use::scratch);
    later = arena.take<LaterSubtree>(most.later_list.size(), Use::scratch);
}

void Launches::upload(const cl::CommandQueue& queue)
{
    subtrees.upload(queue, subtree_list);
    later.upload(queue, later_list);
}

}  // namespace bvhbench
