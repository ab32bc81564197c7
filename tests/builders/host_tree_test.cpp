// SPDX-License-Identifier: MIT
#include "builders/host_tree.h"

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

TEST(InvariantViolation, IsEmptyForATreeThatKeepsThemAll)
{
    EXPECT_EQ(invariant_violation(right_tree(), points, faces), "");
}

TEST(InvariantViolation, NamesEachKindOfFault)
{
    struct Fault {
        void (*put_into)(HostTree&);
        std::string sentence;
    };
    for (const Fault& fault :
         {Fault{[](HostTree& tree) { tree.nodes[2].primitive = 0; }, "triangle 0 is in two leaves"},
          {[](HostTree& tree) {
               tree.nodes[0].child[1] = HostTree::none;
               tree.nodes[0].box = tree.nodes[1].box;
           },
           "1 nodes are not reached from the root"},
          {[](HostTree& tree) { tree.nodes[0].box.max_x = 6; },
           "the box of node 0 is not the union of its children's"},
          {[](HostTree& tree) { tree.nodes[1].box.max_x = 2; },
           "the box of leaf node 1 is not that of its triangle 0"},
          {[](HostTree& tree) { tree.nodes[0].child[1] = 1; },
           "the box of node 0 is not the union of its children's"},
          {[](HostTree& tree) { tree.nodes[0].child[1] = 7; },
           "node 0 has a child that is no node"}}) {
        HostTree tree = right_tree();
        fault.put_into(tree);
        EXPECT_EQ(invariant_violation(tree, points, faces), fault.sentence);
    }
}

TEST(InvariantViolation, LooksAtEveryChildOfAWideNode)
{
    HostTree tree;
    const std::vector<Face> eight(8, faces[0]);
    tree.nodes.resize(9);
    tree.nodes[0].box = face_box(points, faces[0]);
    for (int k = 0; k < 8; ++k) {
        tree.nodes[0].child[static_cast<std::size_t>(k)] = k + 1;
        tree.nodes[static_cast<std::size_t>(k) + 1] = {face_box(points, faces[0]), {}, k};
    }
    EXPECT_EQ(invariant_violation(tree, points, eight), "");
    HostTree fewer = tree;
    fewer.nodes[0].child[7] = HostTree::none;
    EXPECT_EQ(invariant_violation(fewer, points, eight), "1 nodes are not reached from the root");
    EXPECT_NE(tree_hash(fewer), tree_hash(tree));
}

TEST(Refitted, ChangesNothingWhileNothingMoves)
{
    EXPECT_EQ(tree_hash(refitted(right_tree(), points, faces)), tree_hash(right_tree()));
}

TEST(Refitted, PutsBoxesAroundMovedPointsAndKeepsTheTree)
{
    HostTree support = right_tree();  // a node with one child on the path to leaf 2
    support.nodes.push_back(support.nodes[2]);
    support.nodes[2] = {{}, {3, HostTree::none}, HostTree::none};

    std::vector<Point> moved = points;
    moved[3] = {-1, 2, 9};
    for (const HostTree& tree : {right_tree(), support}) {
        const HostTree after = refitted(tree, moved, faces);
        EXPECT_EQ(invariant_violation(after, moved, faces), "");
        EXPECT_EQ(after.nodes[0].box.max_z, 9);
        EXPECT_EQ(after.nodes[0].box.min_x, -1);
        ASSERT_EQ(after.nodes.size(), tree.nodes.size());
        for (std::size_t k = 0; k < tree.nodes.size(); ++k) {
            EXPECT_EQ(after.nodes[k].child, tree.nodes[k].child);
            EXPECT_EQ(after.nodes[k].primitive, tree.nodes[k].primitive);
        }
    }
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
