// SPDX-License-Identifier: MIT
#include "builders/implicit/later_subtrees.h"

namespace bvhbench {

std::vector<LaterSubtree> later_subtrees(std::span<const uint> objects,
                                         std::span<const SubtreeSchedule> schedules)
{
    std::vector<LaterSubtree> list;
    std::vector<uint> below;  // where the roots of the round before begin, by object
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

}  // namespace bvhbench
