// SPDX-License-Identifier: MIT
#include "collide/oracles/box_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "collide/oracles/sweep.h"

namespace bvhbench {

PairList overlapping_pairs(std::span<const Aabb> boxes, const WantedPairs& wanted)
{
    if constexpr (has_exact_reference)
        return pairs_of_cgal(boxes, wanted);
    else
        return swept_pairs(boxes, wanted);
}

void pad_boxes(std::span<Aabb> boxes, double distance)
{
    constexpr float most = std::numeric_limits<float>::max();
    const auto low = [&](float side) {
        const double end = std::max<double>(-most, side - distance / 2);
        return std::nextafter(static_cast<float>(end), -most);
    };
    for (Aabb& box : boxes)
        for (const auto& [min, max] :
             {std::pair(&Aabb::min_x, &Aabb::max_x), std::pair(&Aabb::min_y, &Aabb::max_y),
              std::pair(&Aabb::min_z, &Aabb::max_z)}) {
            box.*min = low(box.*min);
            box.*max = -low(-(box.*max));
        }
}

PairList touching_pairs(std::span<const Aabb> boxes, std::span<const Face> faces,
                        bool keep_adjacent, std::span<const FaceRange> objects, Among among,
                        const ObjectFilter& filter)
{
    return overlapping_pairs(boxes, WantedPairs(faces, keep_adjacent, objects, among, filter));
}

PairList touching_pairs(std::span<const Point> points, std::span<const Face> faces,
                        bool keep_adjacent, std::span<const FaceRange> objects, Among among,
                        const ObjectFilter& filter)
{
    return touching_pairs(face_boxes(points, faces), faces, keep_adjacent, objects, among, filter);
}

}  // namespace bvhbench
