// SPDX-License-Identifier: MIT
//
// Distances and closest points of triangles, against CGAL's exact distances, over all classes of difficult pairs; and depths of those that
// meet.
#include "collide/within/closest.h"

#include <cmath>

#include "collide/within/depth.h"
#include "collide/within/distance_filter.h"
#include "tests/collide/narrow_testing.h"

namespace bvhbench {
namespace {

double length(Vector a) { return std::hypot(a.x, a.y, a.z); }
Vector as_vector(Point p) { return {p.x, p.y, p.z}; }

/// Returns the largest coordinate of the corners.
double size_of(const Corners& a, const Corners& b)
{
    double size = 0;
    for (const Corners& corners : {a, b})
        for (const Point p : corners.at)
            size = std::max(size, largest(as_vector(p)));
    return size;
}

/// Returns how far a point is beyond a triangle: along axes, sides and normals, and perpendicular to each side in the plane.
double beyond(Vector point, const Corners& triangle)
{
    Vector at[3];
    for (std::size_t k = 0; k < 3; ++k)
        at[k] = as_vector(triangle.at[k]);
    const Vector normal = cross_product(less(at[1], at[0]), less(at[2], at[0]));
    std::vector<Vector> ways = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, normal};
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector side = less(at[(k + 1) % 3], at[k]);
        ways.insert(ways.end(), {side, cross_product(side, normal)});
    }
    double most = 0;
    for (const Vector way : ways) {
        const double scale = largest(way);
        if (!(scale >= 0x1p-400))
            continue;
        const Vector scaled = {way.x / scale, way.y / scale, way.z / scale};
        const double along[] = {dot(less(at[0], point), scaled), dot(less(at[1], point), scaled),
                                dot(less(at[2], point), scaled)};
        const auto [low, high] = std::minmax({along[0], along[1], along[2]});
        most = std::max({most, low, -high});
    }
    return most;
}

/// Expects a distance that CGAL's differs from by less than 1e-10 of it, and points as closest.h says.
void expect_closest(const Mesh& mesh, Pair pair)
{
    const Corners a = corners_of(mesh.points, mesh.faces[pair.a]);
    const Corners b = corners_of(mesh.points, mesh.faces[pair.b]);
    const Closest found = closest_points(a, b);
    const auto is_within = [&](double distance) {
        return pairs_within(mesh.points, mesh.faces, {&pair, 1}, true, distance).size() == 1;
    };
    ASSERT_TRUE(found.distance >= 0 && std::isfinite(found.distance));
    EXPECT_TRUE(is_within(found.distance * (1 + 1e-10))) << found.distance << spelled(mesh, pair);
    if (found.distance > 0) {
        EXPECT_FALSE(is_within(found.distance * (1 - 1e-10)))
            << found.distance << spelled(mesh, pair);
    }
    const double size = size_of(a, b), error = 0x1p-47 * size;
    EXPECT_LE(std::fabs(length(less(found.b, found.a)) - found.distance), error);
    EXPECT_LE(beyond(found.a, a), error) << spelled(mesh, pair);
    EXPECT_LE(beyond(found.b, b), error) << spelled(mesh, pair);
    const Closest other = closest_points(b, a);
    EXPECT_LE(std::fabs(other.distance - found.distance), 2e-10 * found.distance);
    if (found.distance == 0) {
        EXPECT_EQ(length(less(found.a, found.b)), 0) << "one point of both";
    }
}

class ClosestTest : public OfAClass {};

TEST_P(ClosestTest, AreAsFarApartAsCgalSays)
{
    const Mesh mesh = apart_pairs(GetParam(), takes_all_cases() ? 4000 : 100, 11);
    for (const Pair pair : neighbours(mesh))
        expect_closest(mesh, pair);
}

/// Pairs of unlike classes, far from each other or among each other: what no class has.
TEST_P(ClosestTest, AreThoseOfTrianglesOfSeveralPairs)
{
    const Mesh mesh = apart_pairs(GetParam(), 50, 12);
    for (uint k = 0; k + 3 < mesh.faces.size(); ++k)
        expect_closest(mesh, {k, k + 3});
}

INSTANTIATE_TEST_SUITE_P(Of, ClosestTest, all_classes, CaseName());

TEST(Depth, IsTheShortestMoveAfterWhichTrianglesDoNotMeet)
{
    const Mesh mesh = apart_pairs(find_pair_class("generic"), 2'000, 1);
    Dice dice(1);
    std::size_t compared = 0;
    for (uint k = 0; k < mesh.faces.size(); k += 2) {
        const Corners a = corners_of(mesh.points, mesh.faces[k]),
                      b = corners_of(mesh.points, mesh.faces[k + 1]);
        const Vector way = shortest_way_apart(a, b);
        const double depth = length(way);
        const auto meet_after = [&](Vector by, double far) {
            const double factor = far / length(by);
            Corners moved = b;
            for (Point& p : moved.at)
                p = {float(p.x + factor * by.x), float(p.y + factor * by.y),
                     float(p.z + factor * by.z)};
            return triangles_meet(a, moved);
        };
        if (!triangles_meet(a, b) || depth < 1e-2)
            continue;
        ++compared;
        EXPECT_FALSE(meet_after(way, 1.001 * depth));
        for (int other = 0; other < 100; ++other) {
            const Point p = dice.point();
            EXPECT_TRUE(meet_after({p.x - 0.5, p.y - 0.5, p.z - 0.5}, 0.999 * depth));
        }
    }
    EXPECT_GT(compared, 100u);
    const Corners flat = {{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}},
                  pierced = {{{1, 0, 1}, {0, 1, 1}, {0.5f, 0.5f, -0.25f}}};
    EXPECT_EQ(std::abs(shortest_way_apart(flat, pierced).z), 0.25);
    EXPECT_EQ(shortest_way_apart(flat, flat).z, 0) << "it slides out of its plane";
}

}  // namespace
}  // namespace bvhbench
