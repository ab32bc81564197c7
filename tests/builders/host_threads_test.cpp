// SPDX-License-Identifier: MIT
//
// Host threads give the same results as kernels, object by object, in trees of one subtree and of several.
#include "builders/host_tree.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

using Tested = std::tuple<std::vector<std::size_t>, bool>;

class HostThreads : public testing::TestWithParam<Tested> {
protected:
    std::vector<std::uint64_t> hashes(const char* name) const
    {
        const auto& [sizes, sorted_leaves] = GetParam();
        const ManyObjects many(sizes);
        const Standing forest =
            many.standing(find_builder(name).make, {.sorted_leaves = sorted_leaves});
        std::vector<std::uint64_t> hashes;
        for (uint k = 0; k < forest.device_tree().objects.size(); ++k)
            hashes.push_back(tree_hash(forest.device_tree().object_to_host_tree(k)));
        return hashes;
    }
};

TEST_P(HostThreads, LeaveTheTreesThatKernelsLeave)
{
    const std::vector<std::uint64_t> expected = hashes("oibvh-multi");
    EXPECT_EQ(expected.size(), std::get<0>(GetParam()).size());
    EXPECT_EQ(hashes("oibvh-host"), expected);
}

INSTANTIATE_TEST_SUITE_P(
    Sizes, HostThreads,
    testing::Combine(testing::Values(std::vector<std::size_t>{4096}, std::vector<std::size_t>{4097},
                                     std::vector<std::size_t>{30001},
                                     std::vector<std::size_t>{1, 9000, 3, 70, 2, 12289}),
                     testing::Bool()));

TEST(HostThreadsStage, IsTimedByTheHostsClockAndLaunchesNothing)
{
    const ManyObjects many({5000});
    const Standing one = many.standing(find_builder("oibvh-host").make);
    const StageTime hierarchy =
        session().build_once(*one.builder, one.input, Start::from_triangles).back();
    EXPECT_EQ(hierarchy.stage, "hierarchy");
    EXPECT_EQ(hierarchy.launches, 0);
    EXPECT_GT(hierarchy.wall_ns, 0);
}

}  // namespace
}  // namespace bvhbench
