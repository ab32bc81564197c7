// SPDX-License-Identifier: MIT
#include "harness/accuracy/error_sizes.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "collide/narrow/narrow.h"
#include "collide/within/closest.h"
#include "collide/within/depth.h"
#include "geometry/cores.h"
#include "harness/accuracy/axis.h"

namespace bvhbench {
namespace {

/// Returns the pairs that only `one` has, or `most` of them.
std::vector<Pair> only_in(const PairList& one, const PairList& other, std::size_t most)
{
    std::vector<Pair> pairs;
    std::ranges::set_difference(one.pairs(), other.pairs(), std::back_inserter(pairs));
    for (std::size_t k = 0; pairs.size() > most && k < most; ++k)
        pairs[k] = pairs[k * (pairs.size() / most)];
    pairs.resize(std::min(pairs.size(), most));
    return pairs;
}

}  // namespace

double value_at(std::span<const double> sorted, double share)
{
    return sorted.empty()
               ? 0
               : sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
}

void ErrorSizes::add(const PairList& found, const PairList& right, std::span<const Point> points,
                     std::span<const Face> faces, double unit, std::size_t most)
{
    const auto add = [&](const std::vector<Pair>& pairs, std::vector<double>& sizes,
                         const auto& size) {
        const std::size_t before = sizes.size();
        sizes.resize(before + pairs.size());
        on_all_cores(pairs.size(), [&](std::size_t k) {
            const Corners a = corners_of(points, faces[pairs[k].a]),
                          b = corners_of(points, faces[pairs[k].b]);
            const Point six[] = {a.at[0], a.at[1], a.at[2], b.at[0], b.at[1], b.at[2]};
            const double whole = unit > 0 ? unit : longest_side(six);
            sizes[before + k] = whole > 0 ? size(a, b) / whole : 0;
        });
    };
    add(only_in(right, found, most), depths_, [](const Corners& a, const Corners& b) {
        const Vector way = shortest_way_apart(a, b);
        return std::hypot(way.x, way.y, way.z);
    });
    add(only_in(found, right, most), gaps_,
        [](const Corners& a, const Corners& b) { return closest_points(a, b).distance; });
}

void ErrorSizes::put(Cell& cell)
{
    const auto put = [&](const std::string& name, std::vector<double>& sizes) {
        if (sizes.empty())
            return;
        std::ranges::sort(sizes);
        cell.counters[name + "_median"] = value_at(sizes, 0.5);
        cell.counters[name + "_99_percent"] = value_at(sizes, 0.99);
        cell.counters[name + "_most"] = sizes.back();
    };
    put("missed_depth", depths_);
    put("false_gap", gaps_);
}

}  // namespace bvhbench
