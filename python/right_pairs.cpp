// SPDX-License-Identifier: MIT
#include "python/right_pairs.h"

#include <algorithm>

#include "collide/narrow/narrow.h"
#include "collide/oracles/box_pairs.h"
#include "collide/within/within.h"
#include "library/device.h"

namespace bvhbench::python {
namespace {

PairList found(const std::string& answer, std::span<const Point> points,
               std::span<const Face> faces, bool adjacent, double distance)
{
    std::vector<Aabb> boxes = face_boxes(points, faces);
    if (answer == "within")
        pad_boxes(boxes, distance);
    const PairList overlapping = touching_pairs(boxes, faces, adjacent);
    std::vector<Pair> pairs(overlapping.pairs().begin(), overlapping.pairs().end());
    std::erase_if(pairs, [&](Pair pair) {
        if (answer == "within")
            return !are_within(points, faces, pair,
                               {.distance = distance, .keep_adjacent = adjacent});
        return answer == "contacts" && !triangles_meet(points, faces, pair, adjacent);
    });
    return PairList(std::move(pairs));
}

}  // namespace

Numbers right_pairs(const std::string& answer, const Floats& points, const Numbers& faces,
                    bool adjacent, double distance)
{
    const PairList list = without_gil([&] {
        try {
            return found(answer, values_of<Point>(points), values_of<Face>(faces), adjacent,
                         distance);
        } catch (...) {
            oibvh::rethrow_as_error();
        }
    });
    Numbers array({list.size(), std::size_t{2}});
    if (list.size() > 0)
        std::copy_n(&list.pairs().front().a, 2 * list.size(), array.mutable_data());
    return array;
}

}  // namespace bvhbench::python
