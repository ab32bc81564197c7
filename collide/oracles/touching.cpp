// SPDX-License-Identifier: MIT
#include "collide/oracles/touching.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "geometry/cores.h"
#include "geometry/orient.h"

namespace bvhbench {
namespace {

constexpr std::size_t taken_at_once = 4096;

using Corners = std::array<Point, 3>;

/// A triangle whose first corner is alone on its side of a plane.
struct Straddling {
    bool is_there = false;
    Corners at;
    int side = 0;  ///< of the first corner
};

/// Returns `triangle`, turned so that its first corner is alone on its side of the plane of `other`; nothing if no corners are
/// strictly on both sides.
Straddling straddling(const Corners& triangle, const Corners& other)
{
    std::array<int, 3> side;
    for (std::size_t k = 0; k < 3; ++k)
        side[k] = orient3d(other[0], other[1], other[2], triangle[k]);
    const auto [low, high] = std::ranges::minmax(side);
    if (low >= 0 || high <= 0)
        return {};
    std::size_t k = 0;
    while (side[k] == 0 || side[(k + 1) % 3] == side[k] || side[(k + 2) % 3] == side[k])
        ++k;
    return {true, {triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]}, side[k]};
}

/// True if a segment passes through the inside of a triangle.
bool pierces(Point from, Point to, const Corners& triangle)
{
    const int side = orient3d(triangle[0], triangle[1], triangle[2], from);
    if (side * orient3d(triangle[0], triangle[1], triangle[2], to) != -1)
        return false;
    const int turn = orient3d(from, to, triangle[0], triangle[1]);
    return turn != 0 && orient3d(from, to, triangle[1], triangle[2]) == turn &&
           orient3d(from, to, triangle[2], triangle[0]) == turn;
}

bool has_area(const Corners& at)
{
    return orient2d(at[0], at[1], at[2], 0) != 0 || orient2d(at[0], at[1], at[2], 1) != 0 ||
           orient2d(at[0], at[1], at[2], 2) != 0;
}

bool edge_pierces(const Corners& a, const Corners& b)
{
    return pierces(a[0], a[1], b) || pierces(a[1], a[2], b) || pierces(a[2], a[0], b);
}

/// Decides as [Guigue2003], by strict signs: each triangle meets the line of both planes in an interval, and the intervals have
/// more than a point in common.
bool cross(const Corners& a, const Corners& b)
{
    if (!has_area(a) || !has_area(b))
        return edge_pierces(a, b) || edge_pierces(b, a);
    Straddling first = straddling(a, b), second = straddling(b, a);
    if (!first.is_there || !second.is_there)
        return false;
    if (first.side < 0)  // turns the other's plane round, so that the first corner is above it
        std::swap(second.at[1], second.at[2]);
    if (second.side < 0)
        std::swap(first.at[1], first.at[2]);
    return orient3d(first.at[0], first.at[1], second.at[0], second.at[1]) < 0 &&
           orient3d(first.at[0], first.at[2], second.at[2], second.at[0]) < 0;
}

}  // namespace

std::uint64_t only_touching(std::span<const Point> points, std::span<const Face> faces,
                            std::span<const Pair> contacts)
{
    const auto corners = [&](uint face) {
        const Face& at = faces[face];
        return Corners{points[at.a], points[at.b], points[at.c]};
    };
    std::atomic<std::uint64_t> touching = 0;
    on_all_cores((contacts.size() + taken_at_once - 1) / taken_at_once, [&](std::size_t part) {
        const std::size_t first = part * taken_at_once;
        std::uint64_t count = 0;
        for (const Pair pair :
             contacts.subspan(first, std::min(taken_at_once, contacts.size() - first)))
            count += cross(corners(pair.a), corners(pair.b)) ? 0 : 1;
        touching += count;
    });
    return touching;
}

}  // namespace bvhbench
