// SPDX-License-Identifier: MIT
//
// Threads of the host leave what kernels leave, object by object, in trees of one subtree and of several.
#include "builders/device_tree.h"
#include "builders/spell_out.h"
#include "tests/collide/collider_testing.h"
#include "tests/collide/many_objects.h"

namespace bvhbench {
namespace {

using Tested = std::tuple<std::vector<std::size_t>, bool>;

class HostThreads : public testing::TestWithParam<Tested> {
protected:
    std::vector<std::uint64_t> hashes(const char* name, const Input& input) const
    {
        const auto builder = find_builder(name).make(session().programs(),
                                                     {.sorted_leaves = std::get<1>(GetParam())});
        builder->reserve_objects(object_sizes(input));
        const Tree* tree = nullptr;
        session().build_once(*builder, input, Start::from_triangles, &tree);
        const auto& forest = dynamic_cast<const DeviceTree&>(*tree);
        std::vector<std::uint64_t> hashes;
        for (uint k = 0; k < forest.objects.size(); ++k)
            hashes.push_back(tree_hash(forest.spelled_out_object(k)));
        return hashes;
    }
};

TEST_P(HostThreads, LeaveTheTreesThatKernelsLeave)
{
    const ManyObjects many(std::get<0>(GetParam()));
    const Input input = upload(session().device(), session().queue(), many.mesh.points,
                               many.mesh.faces, many.objects);
    const std::vector<std::uint64_t> expected = hashes("oibvh-multi", input);
    EXPECT_EQ(expected.size(), many.objects.size());
    EXPECT_EQ(hashes("oibvh-host", input), expected);
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
    const Input input = upload(session().device(), session().queue(), many.mesh.points,
                               many.mesh.faces, many.objects);
    const auto builder = find_builder("oibvh-host").make(session().programs(), {});
    builder->reserve(input.triangle_count());
    const StageTime hierarchy = session().build_once(*builder, input, Start::from_triangles).back();
    EXPECT_EQ(hierarchy.stage, "hierarchy");
    EXPECT_EQ(hierarchy.launches, 0);
    EXPECT_GT(hierarchy.wall_ns, 0);
}

}  // namespace
}  // namespace bvhbench
