// SPDX-License-Identifier: MIT
//
// Assumptions about the wrapped libraries. tests/builders/contract_test.cpp tests what all builders guarantee.

#include "tests/baselines/testing.h"
#include "tests/needing.h"
#include "tests/refusal.h"

namespace bvhbench {
namespace {

class Embree : public Needing<testing::Test, embree_absent> {};

class Fcl : public Needing<testing::Test, fcl_absent> {};

std::uint64_t hash_over(MakeBuilder make, const Mesh& mesh)
{
    return tree_hash(tree_over(make, mesh));
}

TEST_F(Embree, CostsLessOfMediumQualityAndBuildsHighAlikeWhenItMayNotSplitTriangles)
{
    const Mesh torus = mesh_of("torus:5000");
    const HostTree medium = tree_over(make_embree_medium, torus);
    EXPECT_LT(inner_surface(medium), inner_surface(tree_over(make_embree_low, torus)));
    EXPECT_EQ(hash_over(make_embree_high, torus), tree_hash(medium));
}

TEST_F(Embree, LeavesTheSameTreeEachTimeFromManyThreads)
{
    // Both meshes are large enough for Embree's parallel code. In the second all triangles are equal, so all splits cost as much.
    Mesh same{{{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}, std::vector<Face>(50000, Face{0, 1, 2})};
    for (const Mesh& mesh : {mesh_of("torus:50000"), same})
        for (const MakeBuilder make : {make_embree_low, make_embree_medium}) {
            const std::uint64_t first = hash_over(make, mesh);
            for (int again = 0; again < 5; ++again)
                EXPECT_EQ(hash_over(make, mesh), first);
        }
}

TEST_F(Embree, RefusesCoordinatesItWouldDropTrianglesFor)
{
    Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e19f, 0, 0}}, {{0, 1, 2}, {0, 1, 3}}};
    EXPECT_EQ(refusal_of([&] { tree_over(make_embree_medium, mesh); }),
              "Embree takes no coordinates beyond 1.8e18, and triangle 1 has some");
    mesh.points.back().x = 1e18f;
    tree_over(make_embree_medium, mesh);
}

TEST_F(Fcl, PutsATriangleInEachLeafAndCutsElsewhereWithOrientedBoxes)
{
    const Mesh torus = mesh_of("torus:5000");
    const HostTree aligned = tree_over(make_fcl_aabb, torus);
    const HostTree oriented = tree_over(make_fcl_obbrss, torus);
    for (const HostTree* tree : {&aligned, &oriented})
        EXPECT_EQ(tree->nodes.size(), 2 * torus.faces.size() - 1);
    EXPECT_NE(tree_hash(aligned), tree_hash(oriented));
}

}  // namespace
}  // namespace bvhbench
