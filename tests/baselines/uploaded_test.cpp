// SPDX-License-Identifier: MIT
//
// Trees of builders on the host, copied to the device.
#include "baselines/radix/uploaded.h"

#include "builders/host_tree.h"
#include "tests/collide/collider_testing.h"
#include "tests/refusal.h"

namespace bvhbench {
namespace {

/// A tree that a test writes.
struct Written final : Tree {
    HostTree plain;

    std::size_t node_count() const override { return plain.nodes.size(); }
    HostTree to_host_tree() const override { return plain; }

    int add_leaf(const Input& input, int triangle)
    {
        plain.nodes.push_back(
            {leaf_box(input, input.faces[static_cast<std::size_t>(triangle)]), {}, triangle});
        return static_cast<int>(plain.nodes.size()) - 1;
    }
};

/// Returns a tree whose inner nodes have a leaf and the rest.
Written line_of(const Input& input)
{
    Written tree;
    const auto triangles = static_cast<int>(input.triangle_count());
    Aabb all = empty_box();
    for (const Aabb& box : leaf_boxes(input))
        all = merged(all, box);
    for (int k = 0; k + 1 < triangles; ++k) {
        tree.plain.nodes.push_back({all, {2 * k + 1, 2 * k + 2}});
        tree.add_leaf(input, k);
    }
    tree.add_leaf(input, triangles - 1);
    return tree;
}

void expect_refused(const Tree& tree, const Input& input, const std::string& says)
{
    UploadedTree uploaded(session().device());
    const std::string why = refusal_of([&] { uploaded.copy(tree, input, session().queue()); });
    EXPECT_NE(why.find(says), std::string::npos) << why;
}

TEST(UploadedTrees, AreThoseOfTheHostAndEveryColliderFindsTheOraclesPairs)
{
    for (const std::size_t size : {1u, 2u, 3u, 700u})
        for (const char* builder :
             {"median-split", "heap-median", "sah-binned", "oibvh-reference"}) {
            SCOPED_TRACE(std::to_string(size) + " triangles, " + builder);
            Standing standing(scene_mesh("soup:" + std::to_string(size)), builder);
            UploadedTree uploaded(session().device());
            const HostTree own = standing.tree->to_host_tree();
            standing.tree = &uploaded.copy(*standing.tree, standing.input, session().queue());
            const bool has_support = std::string_view(builder) == "oibvh-reference";
            EXPECT_TRUE(has_support || tree_hash(standing.tree->to_host_tree()) == tree_hash(own));
            for (const char* collider : {"leaf", "group", "block", "bvtt"})
                expect_oracles_pairs(*made(collider, {.form = KernelForm::groups}), standing);
        }
}

TEST(UploadedTrees, AreRefusedIfTheyAreNoBinaryTreesOfTheTrianglesOrTooDeep)
{
    const Standing standing(crowded_mesh(60), nullptr);
    const Input& input = standing.input;
    const auto last = static_cast<std::size_t>(2 * input.triangle_count() - 2);
    UploadedTree(session().device()).copy(line_of(input), input, session().queue());

    Written tree = line_of(input);
    tree.plain.nodes[0].child[2] = 5;
    expect_refused(tree, input, "more than two children");
    tree = line_of(input);
    tree.plain.nodes[last].primitive = 0;
    expect_refused(tree, input, "triangle 0 is in two leaves");
    tree = line_of(input);
    tree.plain.nodes[0].child = {1, 4};
    expect_refused(tree, input, "triangles");
    tree = line_of(input);
    tree.plain.nodes[last - 2].child = {0, 1};
    expect_refused(tree, input, "malformed");

    const Standing many(scene_mesh("soup:200"), nullptr);
    expect_refused(line_of(many.input), many.input, "it has 200 levels");
}

}  // namespace
}  // namespace bvhbench
