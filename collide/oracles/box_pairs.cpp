// SPDX-License-Identifier: MIT
#include "collide/oracles/box_pairs.h"

#include "collide/oracles/sweep.h"

namespace bvhbench {

PairList overlapping_pairs(std::span<const Aabb> boxes, const WantedPairs& wanted)
{
    if constexpr (has_exact_reference)
        return pairs_of_cgal(boxes, wanted);
    else
        return swept_pairs(boxes, wanted);
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
