// SPDX-License-Identifier: MIT
//
// What we believe of the libraries we wrap. Their promises as builders are in tests/builders/contract_test.cpp.
#include <gtest/gtest.h>

#include "geometry/error.h"
#include "tests/baselines/testing.h"

namespace bvhbench {
namespace {

/// Through a pointer: compilers warn that a function, where it is one, is never null.
bool is_built(MakeBuilder make) { return make != nullptr; }

std::uint64_t hash_over(MakeBuilder make, const Mesh& mesh)
{
    return tree_hash(tree_over(make, mesh));
}

TEST(Embree, CostsLessTheHigherTheQuality)
{
    if (!is_built(make_embree_low))
        GTEST_SKIP() << "built without Embree";
    const Mesh torus = mesh_of("torus:5000");
    const double low = inner_surface(tree_over(make_embree_low, torus));
    const double medium = inner_surface(tree_over(make_embree_medium, torus));
    EXPECT_LT(medium, low);
    EXPECT_LE(inner_surface(tree_over(make_embree_high, torus)), low);
}

TEST(Embree, BuildsHighAsMediumWhenItMayNotSplitTriangles)
{
    if (!is_built(make_embree_low))
        GTEST_SKIP() << "built without Embree";
    const Mesh torus = mesh_of("torus:5000");
    EXPECT_EQ(hash_over(make_embree_high, torus), hash_over(make_embree_medium, torus));
}

TEST(Embree, LeavesTheSameTreeEachTimeFromManyThreads)
{
    if (!is_built(make_embree_low))
        GTEST_SKIP() << "built without Embree";
    // Large enough for its parallel paths; of triangles that are all the same, any half would do.
    Mesh same{{{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}, std::vector<Face>(50000, Face{0, 1, 2})};
    for (const Mesh& mesh : {mesh_of("torus:50000"), same})
        for (const MakeBuilder make : {make_embree_low, make_embree_medium}) {
            const std::uint64_t first = hash_over(make, mesh);
            for (int again = 0; again < 5; ++again)
                EXPECT_EQ(hash_over(make, mesh), first);
        }
}

TEST(Embree, RefusesCoordinatesItWouldDropTrianglesFor)
{
    if (!is_built(make_embree_low))
        GTEST_SKIP() << "built without Embree";
    Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e19f, 0, 0}}, {{0, 1, 2}, {0, 1, 3}}};
    try {
        tree_over(make_embree_medium, mesh);
        FAIL();
    } catch (const Unavailable& refusal) {
        EXPECT_STREQ(refusal.what(),
                     "Embree takes no coordinates beyond 1.8e18, and triangle 1 has some");
    }
    mesh.points.back().x = 1e18f;
    tree_over(make_embree_medium, mesh);
}

TEST(Fcl, PutsATriangleInEachLeaf)
{
    if (!is_built(make_fcl_aabb))
        GTEST_SKIP() << "built without FCL";
    const Mesh torus = mesh_of("torus:5000");
    for (const MakeBuilder make : {make_fcl_aabb, make_fcl_obbrss})
        EXPECT_EQ(tree_over(make, torus).nodes.size(), 2 * torus.faces.size() - 1);
}

TEST(Fcl, CutsElsewhereWithOrientedBoxes)
{
    if (!is_built(make_fcl_aabb))
        GTEST_SKIP() << "built without FCL";
    const Mesh torus = mesh_of("torus:5000");
    EXPECT_NE(hash_over(make_fcl_aabb, torus), hash_over(make_fcl_obbrss, torus));
}

}  // namespace
}  // namespace bvhbench
