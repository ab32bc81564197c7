// SPDX-License-Identifier: MIT
//
// Compares which contacts only touch with intervals of fractions on the line that two planes share, over triangles with small whole
// coordinates, of which many meet at corners, at edges and in planes.
#include "collide/oracles/touching.h"

#include <gtest/gtest.h>

#include <array>
#include <optional>
#include <random>

namespace bvhbench {
namespace {

using Whole = std::array<long, 3>;
using Corners = std::array<Whole, 3>;

Whole minus(Whole a, Whole b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Whole times(Whole a, Whole b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
long dot(Whole a, Whole b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Whole normal(const Corners& t) { return times(minus(t[1], t[0]), minus(t[2], t[0])); }

struct Fraction {
    long over, under;  ///< under > 0
    bool operator<(const Fraction& other) const { return over * other.under < other.over * under; }
};

/// Returns where a triangle meets a plane, along `line`; nothing if its corners are not strictly on both sides.
std::optional<std::array<Fraction, 2>> interval(const Corners& t, const Corners& plane, Whole line)
{
    std::array<long, 3> side;
    for (std::size_t k = 0; k < 3; ++k)
        side[k] = dot(normal(plane), minus(t[k], plane[0]));
    std::vector<Fraction> ends;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t next = (k + 1) % 3;
        if (side[k] == 0)
            ends.push_back({dot(line, t[k]), 1});
        if (side[k] * side[next] < 0) {
            const long under = side[k] - side[next], sign = under < 0 ? -1 : 1;
            ends.push_back(
                {sign * (dot(line, t[k]) * under + side[k] * dot(line, minus(t[next], t[k]))),
                 sign * under});
        }
    }
    const auto [low, high] = std::minmax_element(side.begin(), side.end());
    if (*low >= 0 || *high <= 0)
        return std::nullopt;
    return std::array{std::min(ends[0], ends[1]), std::max(ends[0], ends[1])};
}

bool cross(const Corners& a, const Corners& b)
{
    const Whole line = times(normal(a), normal(b));
    const auto of_a = interval(a, b, line), of_b = interval(b, a, line);
    return of_a && of_b && (*of_a)[0] < (*of_b)[1] && (*of_b)[0] < (*of_a)[1];
}

TEST(Touching, IsAllThatDoesNotCross)
{
    std::mt19937 chance(1);
    std::vector<Point> points;
    std::vector<Face> faces;
    std::vector<Pair> pairs;
    std::uint64_t touching = 0, wrong = 0;
    while (pairs.size() < 20000) {
        std::array<Corners, 2> both;
        for (Corners& corners : both)
            for (Whole& corner : corners)
                for (long& x : corner)
                    x = static_cast<long>(chance() % 4);
        if (normal(both[0]) == Whole{} || normal(both[1]) == Whole{})
            continue;
        for (const Corners& corners : both) {
            const auto first = static_cast<uint>(points.size());
            for (const auto& [x, y, z] : corners)
                points.push_back(
                    {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)});
            faces.push_back({first, first + 1, first + 2});
        }
        pairs.push_back({static_cast<uint>(faces.size() - 2), static_cast<uint>(faces.size() - 1)});
        const bool touches = !cross(both[0], both[1]);
        touching += touches ? 1 : 0;
        wrong += only_touching(points, faces, {&pairs.back(), 1}) != (touches ? 1 : 0) ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_EQ(only_touching(points, faces, pairs), touching);
}

TEST(Touching, OfASegmentIsAllButPassingThroughTheInside)
{
    const std::vector<Point> points = {{0, 0, 0},  {4, 0, 0}, {0, 4, 0}, {1, 1, -1}, {1, 1, 1},
                                       {2, 2, -1}, {2, 2, 1}, {1, 1, 0}, {1, 1, 2}};
    const std::vector<Face> faces = {{0, 1, 2}, {3, 4, 4}, {5, 6, 6}, {7, 8, 8}, {3, 4, 8}};
    const auto touches = [&](uint other) {
        const std::vector<Pair> pair = {{0, other}};
        return only_touching(points, faces, pair) == 1;
    };
    EXPECT_FALSE(touches(1));  // through the inside
    EXPECT_TRUE(touches(2));   // through an edge
    EXPECT_TRUE(touches(3));   // ends on the inside
    EXPECT_FALSE(touches(4));  // through the inside, with a corner between
}

}  // namespace
}  // namespace bvhbench
