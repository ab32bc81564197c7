// SPDX-License-Identifier: MIT
#include "cluster/halo.h"

#include <cassert>

namespace bvhbench {
namespace {

bool overlaps_any(const Aabb& box, std::span<const Aabb> boxes)
{
    return std::ranges::any_of(boxes, [&](const Aabb& other) { return overlap(box, other); });
}

}  // namespace

WantedBoxes wanted_from(uint own, std::span<const Aabb> tops)
{
    assert(tops.size() % top_boxes == 0);
    const auto of_rank = [&](uint rank) {
        return tops.subspan(std::size_t{top_boxes} * rank, top_boxes);
    };
    WantedBoxes wanted;
    for (uint rank = 0; rank < tops.size() / top_boxes; ++rank)
        if (sends_to(own, rank))
            for (const Aabb& box : of_rank(rank))
                if (overlaps_any(box, of_rank(own))) {
                    wanted.boxes.push_back(box);
                    wanted.ranks.push_back(rank);
                }
    return wanted;
}

std::vector<Pair> leaving(std::span<const Aabb> boxes, const WantedBoxes& wanted)
{
    std::vector<Pair> all;
    for (uint triangle = 0; triangle < boxes.size(); ++triangle)
        for (std::size_t k = 0; k < wanted.boxes.size(); ++k) {
            const Pair one = {triangle, wanted.ranks[k]};
            if (overlap(boxes[triangle], wanted.boxes[k]) && (all.empty() || all.back() != one))
                all.push_back(one);
        }
    return all;
}

}  // namespace bvhbench
