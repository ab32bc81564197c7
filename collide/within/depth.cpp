// SPDX-License-Identifier: MIT
#include "collide/within/depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace bvhbench {
namespace {

using Spans = std::array<Vector, 3>;

double length(Vector a) { return std::hypot(a.x, a.y, a.z); }

Vector times(double factor, Vector a) { return {factor * a.x, factor * a.y, factor * a.z}; }

Spans edges_of(const Corners& a)
{
    return {difference(a.at[1], a.at[0]), difference(a.at[2], a.at[1]),
            difference(a.at[0], a.at[2])};
}

/// Returns the direction perpendicular to two edges, of length 1; nothing if they are parallel but for rounding.
std::optional<Vector> perpendicular(Vector a, Vector b)
{
    const Vector normal = cross_product(a, b);
    const double size = length(normal);
    if (!(size > 0x1p-50 * length(a) * length(b)))
        return std::nullopt;
    return times(1 / size, normal);
}

/// Returns how far `b` must move along a direction, or against it, to be beyond `a`: the shorter way.
double way_along(Vector direction, const Corners& a, const Corners& b)
{
    std::array<double, 3> at_a, at_b;
    for (std::size_t k = 0; k < 3; ++k) {
        at_a[k] = dot(difference(a.at[k], a.at[0]), direction);
        at_b[k] = dot(difference(b.at[k], a.at[0]), direction);
    }
    const auto [low_a, high_a] = std::ranges::minmax(at_a);
    const auto [low_b, high_b] = std::ranges::minmax(at_b);
    const double on = std::max(0.0, high_a - low_b), back = std::max(0.0, high_b - low_a);
    return on < back ? on : -back;
}

}  // namespace

Vector shortest_way_apart(const Corners& a, const Corners& b)
{
    const Spans of_a = edges_of(a), of_b = edges_of(b);
    std::vector<std::optional<Vector>> directions = {perpendicular(of_a[0], of_a[1]),
                                                     perpendicular(of_b[0], of_b[1])};
    for (const Vector& one : of_a)
        for (const Vector& other : of_b)
            directions.push_back(perpendicular(one, other));
    std::optional<Vector> shortest;
    for (const std::optional<Vector>& direction : directions) {
        if (!direction)
            continue;
        const Vector way = times(way_along(*direction, a, b), *direction);
        if (!shortest || length(way) < length(*shortest))
            shortest = way;
    }
    return shortest.value_or(Vector{0, 0, 0});
}

}  // namespace bvhbench
