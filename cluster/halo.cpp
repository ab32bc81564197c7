// SPDX-License-Identifier: MIT
#include "cluster/halo.h"

#include <cassert>

namespace bvhbench {
namespace {

/// Returns the part of `box` that triangles inside `boxes` can meet: its common part with the box around those that overlap it.
/// Empty if none does.
Aabb part_inside(const Aabb& box, std::span<const Aabb> boxes)
{
    Aabb around = empty_box();
    for (const Aabb& other : boxes)
        if (overlap(box, other))
            around = merged(around, other);
    return {std::max(box.min_x, around.min_x), std::max(box.min_y, around.min_y),
            std::max(box.min_z, around.min_z), std::min(box.max_x, around.max_x),
            std::min(box.max_y, around.max_y), std::min(box.max_z, around.max_z)};
}

Aabb around(std::span<const Aabb> boxes)
{
    Aabb all = empty_box();
    for (const Aabb& box : boxes)
        all = merged(all, box);
    return all;
}

bool is_empty(const Aabb& box) { return box.min_x > box.max_x; }

}  // namespace

void WantedBoxes::add(uint rank, std::span<const Aabb> of_rank)
{
    if (of_rank.empty())
        return;
    boxes.push_back(around(of_rank));
    boxes.insert(boxes.end(), of_rank.begin(), of_rank.end());
    ranks.push_back({rank, static_cast<uint>(boxes.size())});
}

WantedBoxes wanted_from(uint own, std::span<const Aabb> tops, uint ranks)
{
    assert(tops.size() % ranks == 0);
    const std::size_t each = tops.size() / ranks;
    const auto of_rank = [&](uint rank) { return tops.subspan(each * rank, each); };
    const Aabb around_own = around(of_rank(own));
    WantedBoxes wanted;
    for (uint rank = 0; rank < ranks; ++rank) {
        if (!sends_to(own, rank) || !overlap(around(of_rank(rank)), around_own))
            continue;
        std::vector<Aabb> parts;
        for (const Aabb& box : of_rank(rank))
            if (const Aabb part = part_inside(box, of_rank(own)); !is_empty(part))
                parts.push_back(part);
        wanted.add(rank, parts);
    }
    return wanted;
}

std::vector<Pair> leaving(std::span<const Aabb> boxes, const WantedBoxes& wanted)
{
    std::vector<Pair> all;
    for (uint triangle = 0; triangle < boxes.size(); ++triangle) {
        uint begin = 0;
        for (const auto& [rank, end] : wanted.ranks) {
            const auto of_rank = std::span(wanted.boxes).subspan(begin, end - begin);
            begin = end;
            if (std::ranges::any_of(of_rank.subspan(1),
                                    [&](const Aabb& box) { return overlap(boxes[triangle], box); }))
                all.push_back({triangle, rank});
        }
    }
    return all;
}

}  // namespace bvhbench
