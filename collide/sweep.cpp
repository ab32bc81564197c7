// SPDX-License-Identifier: MIT
#include "collide/sweep.h"

#include <algorithm>
#include <numeric>

#include "collide/relation.h"

namespace bvhbench {
namespace {

struct Axis {
    float Aabb::*min;
    float Aabb::*max;
};

/// The axis along which the boxes spread most: the fewest overlap along it, as a rule.
Axis longest_axis(std::span<const Aabb> boxes)
{
    Aabb all = empty_box();
    for (const Aabb& box : boxes)
        all = merged(all, box);
    const auto length = [&](Axis axis) {
        return static_cast<double>(all.*axis.max) - static_cast<double>(all.*axis.min);
    };
    const Axis axes[] = {
        {&Aabb::min_x, &Aabb::max_x}, {&Aabb::min_y, &Aabb::max_y}, {&Aabb::min_z, &Aabb::max_z}};
    return *std::max_element(std::begin(axes), std::end(axes),
                             [&](Axis a, Axis b) { return length(a) < length(b); });
}

}  // namespace

PairList overlapping_pairs(std::span<const Aabb> boxes)
{
    const Axis axis = longest_axis(boxes);
    std::vector<uint> ids(boxes.size());
    std::iota(ids.begin(), ids.end(), 0u);
    std::sort(ids.begin(), ids.end(),
              [&](uint a, uint b) { return boxes[a].*axis.min < boxes[b].*axis.min; });
    std::vector<Aabb> swept;  // next to each other in memory in the order they are read
    swept.reserve(ids.size());
    for (const uint id : ids)
        swept.push_back(boxes[id]);

    // Of two boxes that overlap, the later to begin does so before the earlier ends.
    std::vector<Pair> found;
    for (std::size_t i = 0; i < swept.size(); ++i) {
        const float end = swept[i].*axis.max;
        for (std::size_t j = i + 1; j < swept.size() && swept[j].*axis.min <= end; ++j)
            if (overlap(swept[i], swept[j]))
                found.push_back({ids[i], ids[j]});
    }
    return PairList(std::move(found));
}

PairList touching_pairs(std::span<const Aabb> boxes, std::span<const Face> faces,
                        bool keep_adjacent)
{
    PairList all = overlapping_pairs(boxes);
    return keep_adjacent ? all : selected(all, {faces, {}}, Relation::apart);
}

PairList touching_pairs(std::span<const Point> points, std::span<const Face> faces,
                        bool keep_adjacent)
{
    return touching_pairs(face_boxes(points, faces), faces, keep_adjacent);
}

}  // namespace bvhbench
