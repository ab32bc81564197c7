// SPDX-License-Identifier: MIT
#include "harness/judge/check.h"

#include <gtest/gtest.h>

#include "builders/spell_out.h"

namespace bvhbench {
namespace {

using enum Check::Verdict;

const std::vector<Face> faces = {{0, 1, 2}, {1, 2, 3}};
const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
const std::vector<Point> moved = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {5, 5, 6}};

HostTree tree_over(const std::vector<Point>& at)
{
    HostTree tree;
    tree.nodes.resize(3);
    tree.nodes[0].child = {1, 2};
    tree.nodes[1].primitive = 0;
    tree.nodes[2].primitive = 1;
    return refitted(std::move(tree), at, faces);
}

/// The verdict on `tree` as a refit, to the moved points, of the tree over those that were.
Check verdict_on(const HostTree& tree)
{
    const HostTree built = tree_over(points);
    const Input input{moved, faces, {}, {}, {}, {}};
    return check_refit(tree, built, input, {agrees, "radix-reference", {}, tree_hash(built)});
}

TEST(CheckRefit, AgreesWithTheHostsRefitOfTheTreeThatStood)
{
    const Check check = verdict_on(tree_over(moved));
    EXPECT_EQ(check.verdict, agrees);
    EXPECT_EQ(check.against, "radix-reference, refitted");
    EXPECT_EQ(check.tree_hash, tree_hash(tree_over(moved)));
}

TEST(CheckRefit, FindsBoxesThatStayedWhereThePointsWere)
{
    const Check check = verdict_on(tree_over(points));
    EXPECT_EQ(check.verdict, differs);
    EXPECT_EQ(check.detail, "the box of leaf node 1 is not that of its triangle 0");
}

TEST(CheckRefit, FindsAnotherTreeEvenIfItIsAValidOne)
{
    HostTree swapped = tree_over(moved);
    std::swap(swapped.nodes[1], swapped.nodes[2]);
    const Check check = verdict_on(swapped);
    EXPECT_EQ(check.verdict, differs);
    EXPECT_TRUE(check.detail.starts_with("a valid tree, but the refit on the host has the hash "));
}

TEST(CheckRefit, DoesNotMakeUpForATreeThatWasWrongBefore)
{
    const Input input{moved, faces, {}, {}, {}, {}};
    const Check check = check_refit(tree_over(moved), tree_over(points), input,
                                    {differs, "radix-reference", "node 3 is lost", 7u});
    EXPECT_EQ(check.verdict, differs);
    EXPECT_EQ(check.detail, "node 3 is lost");
}

}  // namespace
}  // namespace bvhbench
