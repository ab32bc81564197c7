// SPDX-License-Identifier: MIT

#include <bit>
#include <cmath>

#include "tests/baselines/testing.h"

namespace bvhbench {
namespace {

Mesh triangles_at(const std::vector<float>& places)
{
    Mesh mesh;
    for (const float x : places) {
        const auto first = static_cast<uint>(mesh.points.size());
        mesh.points.insert(mesh.points.end(), {{x, 0, 0}, {x, 1, 0}, {x, 0, 1}});
        mesh.faces.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

/// Returns triangles with centres at 1, 2, 4, ... along x, so that every cut between equal bins cuts off few triangles.
Mesh doubling_distances(int triangles)
{
    std::vector<float> places;
    for (int k = 0; k < triangles; ++k)
        places.push_back(std::ldexp(1.0f, k));
    return triangles_at(places);
}

Mesh all_the_same(std::size_t triangles)
{
    return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}, std::vector<Face>(triangles, Face{0, 1, 2})};
}

TEST(MedianSplit, IsAsDeepAsABinaryTreeMustBe)
{
    for (const std::size_t size : {1u, 2u, 3u, 5u, 8u, 9u, 1000u}) {
        const HostTree tree = tree_over(make_median_split, all_the_same(size));
        EXPECT_EQ(depth_of(tree), std::bit_width(size - 1)) << size << " triangles";
    }
    EXPECT_EQ(depth_of(tree_over(make_median_split, mesh_of("torus:5000"))), 13);
    EXPECT_EQ(depth_of(tree_over(make_median_split, doubling_distances(100))), 7);
}

TEST(HeapMedian, NumbersItsNodesLevelByLevelWithoutAGap)
{
    for (const std::size_t size : {1u, 2u, 3u, 5u, 6u, 7u, 100u, 128u, 129u}) {
        const HostTree tree = tree_over(make_heap_median, all_the_same(size));
        ASSERT_EQ(tree.nodes.size(), 2 * size - 1);
        for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
            EXPECT_EQ(tree.nodes[i].primitive == HostTree::none, i < size - 1) << "node " << i;
            if (i < size - 1) {
                EXPECT_EQ(tree.nodes[i].child[0], static_cast<int>(2 * i + 1));
                EXPECT_EQ(tree.nodes[i].child[1], static_cast<int>(2 * i + 2));
            }
        }
    }
}

TEST(HeapMedian, PutsTheFirstCentresAlongTheLongestAxisLeft)
{
    const HostTree tree = tree_over(make_heap_median, doubling_distances(5));
    std::vector<int> leaves;
    for (const std::size_t leaf : {7u, 8u, 4u, 5u, 6u})  // from left to right, see heap_median.cpp
        leaves.push_back(tree.nodes[leaf].primitive);
    EXPECT_EQ(leaves, (std::vector<int>{0, 1, 2, 3, 4}));
}

TEST(BinnedSah, CostsLessThanMediansOnATorus)
{
    const Mesh torus = mesh_of("torus:5000");
    const double sah = inner_surface(tree_over(make_sah_binned, torus));
    const double median = inner_surface(tree_over(make_median_split, torus));
    const double heap = inner_surface(tree_over(make_heap_median, torus));
    EXPECT_LT(sah, median);
    EXPECT_LT(sah, heap);
}

TEST(BinnedSah, CutsBetweenTwoHeapsAtTheRoot)
{
    const HostTree tree =
        tree_over(make_sah_binned, triangles_at({0.0f, 0.1f, 0.2f, 100.0f, 100.1f}));
    EXPECT_EQ(tree.nodes[1].box.max_x, 0.2f);
    EXPECT_EQ(tree.nodes[2].box.min_x, 100.0f);
}

TEST(BinnedSah, FallsBackToHalvesWhereAllCentresAreOne)
{
    EXPECT_EQ(depth_of(tree_over(make_sah_binned, all_the_same(1000))), 10);
}

TEST(BinnedSah, IsNoDeeperThanTheTrianglesForceItToBe)
{
    const int depth = depth_of(tree_over(make_sah_binned, doubling_distances(120)));
    EXPECT_GT(depth, 7);
    EXPECT_LT(depth, 120);
}

}  // namespace
}  // namespace bvhbench
