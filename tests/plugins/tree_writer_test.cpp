// SPDX-License-Identifier: MIT
#include "examples/plugins/tree_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace {

using adapter::Spelled;

/// Returns the triangles of all leaves, sorted, and tests that nodes come before their children and have 1 to 8 entries.
std::vector<uint32_t> triangles_of(const bvhbench_tree& tree)
{
    std::vector<uint32_t> found;
    for (uint64_t n = 0; n < tree.nodes; ++n) {
        const bvhbench_node& node = tree.node[n];
        EXPECT_TRUE(node.count >= 1 && node.count <= 8) << node.count;
        for (uint32_t k = node.first; k < node.first + node.count; ++k) {
            EXPECT_LT(k, tree.entries);
            if (node.is_leaf != 0)
                found.push_back(tree.entry[k]);
            else
                EXPECT_TRUE(tree.entry[k] > n && tree.entry[k] < tree.nodes) << tree.entry[k];
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

TEST(TreeWriter, WritesNodesBeforeTheirChildren)
{
    // A library's node k has the children 2k + 1 and 2k + 2; nodes from 3 on are leaves.
    adapter::TreeWriter writer;
    const bvhbench_tree tree = writer.written(0, [](int k) {
        Spelled<int> spelled{{float(k), 0, 0}, {float(k) + 1, 0, 0}, {}, {}};
        if (k < 3)
            spelled.children = {2 * k + 1, 2 * k + 2};
        else
            spelled.triangles = {uint32_t(10 - k)};
        return spelled;
    });
    EXPECT_EQ(tree.nodes, 7u);
    EXPECT_EQ(triangles_of(tree), (std::vector<uint32_t>{4, 5, 6, 7}));
    EXPECT_EQ(tree.node[0].is_leaf, 0u);
    EXPECT_EQ(tree.node[tree.entry[0]].low[0], 1);
}

TEST(TreeWriter, SplitsALeafOfManyTriangles)
{
    for (const uint32_t count : {1u, 8u, 9u, 20u, 64u, 65u, 1000u}) {
        std::vector<uint32_t> all(count);
        std::iota(all.begin(), all.end(), 0u);
        adapter::TreeWriter writer;
        const bvhbench_tree tree = writer.written(0, [&all](int) {
            return Spelled<int>{{-1, -2, -3}, {1, 2, 3}, {}, all};
        });
        EXPECT_EQ(triangles_of(tree), all);
        EXPECT_EQ(tree.nodes == 1, count <= 8);
        for (uint64_t n = 0; n < tree.nodes; ++n)
            EXPECT_TRUE(tree.node[n].low[2] == -3 && tree.node[n].high[1] == 2);
    }
}

}  // namespace
