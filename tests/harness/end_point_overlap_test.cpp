// SPDX-License-Identifier: MIT
#include "harness/judge/end_point_overlap.h"

#include <gtest/gtest.h>

#include <random>

#include "scenes/generate/generators.h"
#include "tests/harness/host_lbvh.h"

namespace bvhbench {
namespace {

Polygon clipped(const Polygon& polygon, const Aabb& box)
{
    Polygon left;
    clip(polygon, box, left);
    return left;
}

TEST(Clip, KeepsWhatIsInTheClosedBox)
{
    const std::vector<Point> points = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    const Polygon triangle = polygon_of(points, {0, 1, 2});
    EXPECT_DOUBLE_EQ(area(triangle), 8);
    EXPECT_DOUBLE_EQ(area(clipped(triangle, {0, 0, 0, 4, 4, 0})), 8) << "in the box's face";
    EXPECT_DOUBLE_EQ(area(clipped(triangle, {0, 0, -1, 1, 1, 1})), 1);
    EXPECT_DOUBLE_EQ(area(clipped(triangle, {1, 1, -1, 3, 3, 1})), 2) << "one corner is cut off";
    EXPECT_EQ(area(clipped(triangle, {0, 0, 1, 4, 4, 2})), 0);
    EXPECT_EQ(area(clipped(triangle, {4, 4, -1, 5, 5, 1})), 0);
    EXPECT_EQ(area(clipped(triangle, {4, 0, -1, 5, 5, 1})), 0) << "they share a point";
}

TEST(Clip, OfTheCellsOfAGridAddsUpToTheTriangleAndInBoxesWithinEachOtherIsThatToTheLast)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<float> anywhere(-2, 2), inset(0, 0.2f);
    for (int repeat = 0; repeat < 200; ++repeat) {
        std::vector<Point> points(3);
        for (Point& point : points)
            point = {anywhere(random), anywhere(random), anywhere(random)};
        const Polygon triangle = polygon_of(points, {0, 1, 2});
        double sum = 0;
        for (float x = -2; x < 2; ++x)
            for (float y = -2; y < 2; ++y)
                for (float z = -2; z < 2; ++z)
                    sum += area(clipped(triangle, {x, y, z, x + 1, y + 1, z + 1}));
        EXPECT_NEAR(sum, area(triangle), 1e-12);

        Polygon left = triangle;
        Aabb box = {-2, -2, -2, 2, 2, 2};
        while (left.count > 0) {
            left = clipped(left, box);
            EXPECT_LE(left.count, 9);
            EXPECT_NEAR(area(left), area(clipped(triangle, box)), 1e-12);
            box = {box.min_x + inset(random), box.min_y + inset(random), box.min_z + inset(random),
                   box.max_x - inset(random), box.max_y - inset(random), box.max_z - inset(random)};
        }
    }
}

/// Computes the sums by definition: every node against every triangle, without descent or pruning.
AreaSums every_node_against_every_triangle(const HostTree& tree, const Mesh& mesh)
{
    std::vector<std::vector<bool>> below(tree.nodes.size(), std::vector<bool>(mesh.faces.size()));
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
        if (tree.nodes[i].primitive != HostTree::none)
            below[i][static_cast<std::size_t>(tree.nodes[i].primitive)] = true;
        for (const int child : tree.nodes[i].child)
            for (std::size_t k = 0; child != HostTree::none && k < mesh.faces.size(); ++k)
                below[i][k] = below[i][k] || below[static_cast<std::size_t>(child)][k];
    }
    double inner = 0, leaf = 0, surface = 0;
    for (std::size_t k = 0; k < mesh.faces.size(); ++k) {
        const Polygon polygon = polygon_of(mesh.points, mesh.faces[k]);
        surface += area(polygon);
        for (std::size_t i = 0; i < tree.nodes.size(); ++i)
            if (!below[i][k])
                (tree.nodes[i].primitive != HostTree::none ? leaf : inner) +=
                    area(clipped(polygon, tree.nodes[i].box));
    }
    return {inner / surface, leaf / surface};
}

TEST(EndPointOverlap, IsThatOfEveryNodeAgainstEveryTriangle)
{
    for (const Mesh& mesh : {make_soup(300), make_hairball(500), make_torus(400), make_grid(200)})
        for (const HostTree& tree : {host_oi_tree(mesh), host_lbvh(mesh)}) {
            const AreaSums expected = every_node_against_every_triangle(tree, mesh);
            const AreaSums sums = end_point_overlap(tree, mesh.points, mesh.faces).value();
            EXPECT_NEAR(sums.inner, expected.inner, 1e-12 * (1 + expected.inner));
            EXPECT_NEAR(sums.leaf, expected.leaf, 1e-12 * (1 + expected.leaf));
        }
}

TEST(EndPointOverlap, IsTheSameToTheBitOnAnyNumberOfThreads)
{
    const Mesh mesh = make_hairball(5000);
    const HostTree tree = host_oi_tree(mesh);
    const AreaSums one = end_point_overlap(tree, mesh.points, mesh.faces, 1).value();
    for (const unsigned threads : {0u, 2u, 3u, 100u}) {
        const AreaSums sums = end_point_overlap(tree, mesh.points, mesh.faces, threads).value();
        EXPECT_EQ(sums.inner, one.inner) << threads;
        EXPECT_EQ(sums.leaf, one.leaf) << threads;
    }
}

TEST(EndPointOverlap, TakesATreeAsDeepAsItHasLeaves)
{
    const Mesh mesh = make_soup(2000);
    // Triangle i is outside the subtrees of all nodes deeper than the i-th, whose boxes are almost the scene's.
    EXPECT_NEAR(end_point_overlap(host_chain(mesh), mesh.points, mesh.faces)->inner / 1000, 1,
                0.05);
}

}  // namespace
}  // namespace bvhbench
