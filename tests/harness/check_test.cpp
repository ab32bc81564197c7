// SPDX-License-Identifier: MIT
#include "harness/judge/check.h"

#include <gtest/gtest.h>

#include "builders/host_tree.h"
#include "tests/harness/host_lbvh.h"

namespace bvhbench {
namespace {

using enum Check::Verdict;

const std::vector<Face> faces = {{0, 1, 2}, {1, 2, 3}};
const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 5}};
const std::vector<Point> moved = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {5, 5, 6}};

HostTree tree_over(const std::vector<Point>& at) { return host_chain({at, faces}); }

/// Returns the verdict on `tree` as a refit to the moved points; the tree over the original points had the verdict `before`.
Check verdict_on(const HostTree& tree, Check::Verdict before = agrees)
{
    const HostTree built = tree_over(points);
    const Input input{moved, faces, {}, {}, {}, {}};
    return check_refit(tree, built, input,
                       {before, "radix-reference", "as before", tree_hash(built)});
}

TEST(CheckRefit, AgreesWithTheHostsRefitOfTheTreeThatStood)
{
    const Check check = verdict_on(tree_over(moved));
    EXPECT_EQ(check.verdict, agrees);
    EXPECT_EQ(check.against, "radix-reference, refitted");
    EXPECT_EQ(check.tree_hash, tree_hash(tree_over(moved)));
}

TEST(CheckRefit, FindsBoxesThatStayedAnotherTreeAndWhatWasWrongBefore)
{
    HostTree swapped = tree_over(moved);  // a valid tree
    std::swap(swapped.nodes[1], swapped.nodes[2]);
    const Check stayed = verdict_on(tree_over(points)), another = verdict_on(swapped),
                wrong_before = verdict_on(tree_over(moved), differs);
    for (const Check& check : {stayed, another, wrong_before})
        EXPECT_EQ(check.verdict, differs);
    EXPECT_EQ(stayed.detail, "as before; the box of leaf node 1 is not that of its triangle 0");
    EXPECT_TRUE(another.detail.starts_with(
        "as before; a valid tree, but the refit on the host has the hash "));
    EXPECT_EQ(wrong_before.detail, "as before");
}

}  // namespace
}  // namespace bvhbench
