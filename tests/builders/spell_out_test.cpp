// SPDX-License-Identifier: MIT
#include "builders/spell_out.h"

#include <gtest/gtest.h>

namespace bvhbench {
namespace {

const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
const std::vector<Face> faces = {{0, 1, 2}, {1, 2, 3}};

HostTree right_tree()
{
    HostTree tree;
    tree.nodes.resize(3);
    tree.nodes[1] = {face_box(points, faces[0]), {HostTree::none, HostTree::none}, 0};
    tree.nodes[2] = {face_box(points, faces[1]), {HostTree::none, HostTree::none}, 1};
    tree.nodes[0] = {merged(tree.nodes[1].box, tree.nodes[2].box), {1, 2}, HostTree::none};
    return tree;
}

TEST(BrokenPromise, IsEmptyForATreeThatKeepsThemAll)
{
    EXPECT_EQ(broken_promise(right_tree(), points, faces), "");
}

TEST(BrokenPromise, NamesEachKindOfFault)
{
    HostTree tree = right_tree();
    tree.nodes[2].primitive = 0;
    EXPECT_EQ(broken_promise(tree, points, faces), "triangle 0 is in two leaves");

    tree = right_tree();
    tree.nodes[0].child[1] = HostTree::none;
    tree.nodes[0].box = tree.nodes[1].box;
    EXPECT_EQ(broken_promise(tree, points, faces), "1 nodes are not reached from the root");

    tree = right_tree();
    tree.nodes[0].box.max_x = 6;
    EXPECT_NE(broken_promise(tree, points, faces).find("not the union"), std::string::npos);

    tree = right_tree();
    tree.nodes[1].box.max_x = 2;
    EXPECT_NE(broken_promise(tree, points, faces).find("not that of its triangle"),
              std::string::npos);

    tree = right_tree();
    tree.nodes[0].child[1] = 1;
    EXPECT_NE(broken_promise(tree, points, faces), "");

    tree = right_tree();
    tree.nodes[0].child[1] = 7;
    EXPECT_NE(broken_promise(tree, points, faces), "");
}

TEST(TreeHash, DependsOnTheTreeAndNotOnWhereNodesAreStored)
{
    const HostTree tree = right_tree();
    HostTree moved;
    moved.nodes = {tree.nodes[0], tree.nodes[2], tree.nodes[1]};
    moved.nodes[0].child = {2, 1};
    EXPECT_EQ(tree_hash(tree), tree_hash(moved));

    HostTree swapped = tree;
    swapped.nodes[0].child = {2, 1};
    EXPECT_NE(tree_hash(tree), tree_hash(swapped));
}

}  // namespace
}  // namespace bvhbench
