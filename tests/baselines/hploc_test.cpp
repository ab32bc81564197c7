// SPDX-License-Identifier: MIT
//
// Both forms of hploc build the oracle's tree bit for bit, alone and in a forest, and it has less surface than the radix tree.
#include "builders/device_tree.h"
#include "tests/baselines/radix_testing.h"

namespace bvhbench {
namespace {

constexpr MakeBuilder makers[] = {make_hploc};

void expect_the_references_tree(const Mesh& mesh, const std::vector<BuildOptions>& ways)
{
    expect_the_trees_of(make_hploc_reference, makers, mesh, ways);
}

/// Builds with few lanes and with teams; other group sizes are rounded to those of teams.
std::vector<BuildOptions> both_forms() { return {{}, {.group_size = 32}}; }

TEST(Hploc, EqualsTheReferenceInEveryWayOnSmallTrees)
{
    for (const uint triangles : {1u, 2u, 3u, 16u, 17u, 18u, 33u, 65u, 129u})
        ASSERT_NO_FATAL_FAILURE(expect_the_references_tree(soup(triangles, triangles), ways()));
}

TEST(Hploc, EqualsTheReferenceOnSmallTreesOfEqualCodes)
{
    for (const uint places : {1u, 3u})
        for (const uint triangles : {2u, 5u, 17u, 64u, 100u})
            ASSERT_NO_FATAL_FAILURE(
                expect_the_references_tree(soup(triangles, places), both_forms()));
}

TEST(Hploc, EqualsTheReferenceInEveryWayOnLargerTrees)
{
    for (const uint triangles : {1000u, 4097u})
        for (const uint places : {triangles, triangles / 8})
            ASSERT_NO_FATAL_FAILURE(expect_the_references_tree(soup(triangles, places), ways()));
}

TEST(Hploc, EqualsTheReferenceForEveryCountTo150)
{
    for (uint triangles = 1; triangles <= 150; ++triangles)
        ASSERT_NO_FATAL_FAILURE(
            expect_the_references_tree(soup(triangles, triangles), both_forms()));
}

TEST(Hploc, EqualsTheReferenceOnManyTriangles)
{
    const uint many = takes_all_cases() ? 300007 : 100003;
    ASSERT_NO_FATAL_FAILURE(expect_the_references_tree(soup(many, many), {{}}));
}

TEST(Hploc, EqualsTheReferenceOnTheDeepestTreesOfTheirCodes)
{
    for (const uint copies : {1u, 2u, 64u, 1000u}) {
        ASSERT_NO_FATAL_FAILURE(expect_the_references_tree(ladder(10, copies), both_forms()));
        ASSERT_NO_FATAL_FAILURE(expect_the_references_tree(
            ladder(21, copies), {{.order = "morton63"}, {.order = "kd", .group_size = 32}}));
    }
}

TEST(Hploc, MakesABalancedTreeOfEqualBoxes)
{
    Mesh mesh = soup(1, 1);
    mesh.faces.assign(4096, mesh.faces.front());
    EXPECT_EQ(depth_of(tree_over(make_hploc, mesh)), 12);
}

TEST(Hploc, HasLessSurfaceThanTheRadixTree)
{
    for (const char* scene : {"torus:20000", "sphere:20000", "hairball:20000"}) {
        const Mesh mesh = mesh_of(scene);
        EXPECT_LT(inner_surface(tree_over(make_hploc, mesh)),
                  0.98 * inner_surface(tree_over(make_karras, mesh)))
            << scene;
    }
}

TEST(Hploc, StaysWithinTheLevelsThatItDeclares)
{
    for (const Mesh& mesh : {ladder(10, 3), soup(3000, 3000), mesh_of("hairball:5000")}) {
        const auto builder = make_hploc(bench().programs, {});
        const Input input = upload(bench().device, bench().queue, mesh.points, mesh.faces);
        builder->reserve(mesh.faces.size());
        const auto& tree = dynamic_cast<const DeviceTree&>(builder->build(input, bench().queue));
        EXPECT_LT(depth_of(tree.to_host_tree()), static_cast<int>(tree.most_levels()));
        bench().queue.finish();
    }
}

TEST(Hploc, GivesTheSameTreeEveryTime)
{
    expect_one_tree(*make_hploc(bench().programs, {}), soup(20000, 15000));
}

/// Four objects leave all bits of a code of 30 in a word, and no two codes of an object here are equal: so its tree is that of the
/// object alone.
TEST(Hploc, OfAForestMakesTheReferencesTreeOfEachObject)
{
    const std::vector<uint> sizes = {300, 1, 16, 65};
    Mesh all;
    std::vector<Mesh> alone;
    std::vector<FaceRange> objects;
    for (const uint size : sizes) {
        const Mesh& one = alone.emplace_back(soup(size, size));
        objects.push_back({static_cast<uint>(all.faces.size()), size});
        const auto shift = static_cast<uint>(all.points.size());
        for (const Face& face : one.faces)
            all.faces.push_back({face.a + shift, face.b + shift, face.c + shift});
        all.points.insert(all.points.end(), one.points.begin(), one.points.end());
    }
    const Input input = upload(bench().device, bench().queue, all.points, all.faces, objects);
    for (const BuildOptions& options : both_forms()) {
        const auto builder = make_hploc(bench().programs, options);
        builder->reserve_objects(sizes);
        const auto& forest = dynamic_cast<const DeviceTree&>(builder->build(input, bench().queue));
        bench().queue.finish();
        for (uint k = 0; k < sizes.size(); ++k) {
            HostTree tree = forest.object_to_host_tree(k);
            for (HostTree::Node& node : tree.nodes)
                if (node.primitive != HostTree::none)
                    node.primitive -= static_cast<int>(objects[k].first);
            EXPECT_EQ(tree_hash(tree), tree_hash(tree_over(make_hploc_reference, alone[k])))
                << "object " << k << ", groups of " << options.group_size;
        }
    }
}

}  // namespace
}  // namespace bvhbench
