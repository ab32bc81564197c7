// SPDX-License-Identifier: MIT
#include "collide/oracles/box_pairs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "collide/oracles/sweep.h"
#include "geometry/error.h"

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

PairList overlapping_pairs_in_doubles(std::span<const WidePoint> points,
                                      std::span<const Face> faces)
{
    if (points.size() >= 1u << 24)
        throw Unavailable("pairs of boxes of doubles are those of fewer than 2^24 points");
    // Overlap depends only on the order of coordinates on each axis. Each coordinate is therefore replaced by its rank on its
    // axis, an integer that a float holds exactly.
    std::vector<Point> places(points.size());
    for (const auto& [wide, narrow] :
         {std::pair(&WidePoint::x, &Point::x), std::pair(&WidePoint::y, &Point::y),
          std::pair(&WidePoint::z, &Point::z)}) {
        std::vector<double> sorted(points.size());
        std::ranges::transform(points, sorted.begin(), wide);
        std::ranges::sort(sorted);
        for (std::size_t k = 0; k < points.size(); ++k)
            places[k].*narrow = static_cast<float>(
                std::lower_bound(sorted.begin(), sorted.end(), points[k].*wide) - sorted.begin());
    }
    return touching_pairs(places, faces, true);
}

}  // namespace bvhbench
