// SPDX-License-Identifier: MIT
//
// Every builder of radix trees builds the oracle's tree bit for bit, for all sizes, group sizes, leaf storage, code widths and
// numbers of equal codes.
#include "baselines/parameters.h"
#include "baselines/radix/delta.h"
#include "tests/baselines/radix_testing.h"

namespace bvhbench {
namespace {

/// Returns programs of the same device, tuned as one with many lanes.
Programs& programs_of_many_lanes()
{
    static Programs& programs = programs_tuned({{&radix_local, 1}, {&levels_at_once, 1}});
    return programs;
}

/// Makes apetrei-fused whose groups merge their own leaves in local memory. Without a group size a CPU has no groups.
std::unique_ptr<Builder> make_fused_in_groups(Programs&, const BuildOptions& options)
{
    return make_apetrei_fused(programs_of_many_lanes(), options);
}

/// Makes lbvh-levels with all levels in one launch.
std::unique_ptr<Builder> make_levels_at_once(Programs&, const BuildOptions& options)
{
    return make_lbvh_levels(programs_of_many_lanes(), options);
}

constexpr MakeBuilder makers[] = {make_karras,          make_apetrei,     make_apetrei_fused,
                                  make_fused_in_groups, make_lbvh_levels, make_levels_at_once};

void expect_the_references_tree(const Mesh& mesh, const std::vector<BuildOptions>& ways)
{
    expect_the_trees_of(make_radix_reference, makers, mesh, ways);
}

TEST(RadixCommon, CountsSharedBitsOfCodeAndPlace)
{
    EXPECT_EQ(radix_common(1ull << 63, 0, 0, 1), 1u);
    EXPECT_EQ(radix_common(1ull << 32, 0, 0, 1), 32u);
    EXPECT_EQ(radix_common(1ull << 31, 0, 0, 1), 33u);
    EXPECT_EQ(radix_common(6, 0, 7, 1), 64u);
    EXPECT_EQ(radix_common(7, 0, 7, 1u << 31), 65u);
    EXPECT_EQ(radix_common(7, 4, 7, 5), 96u);
}

TEST(RadixBuilders, EqualTheReferenceInEveryWayOnSmallTrees)
{
    for (const uint triangles : {1u, 2u, 3u, 4u, 5u, 7u, 8u, 9u, 63u, 64u, 65u, 129u})
        ASSERT_NO_FATAL_FAILURE(expect_the_references_tree(soup(triangles, triangles), ways()));
}

TEST(RadixBuilders, EqualTheReferenceInEveryWayOnLargerTrees)
{
    for (const uint triangles : {511u, 512u, 513u, 1000u, 4097u, 33000u})
        for (const uint places : {triangles, triangles / 8})
            ASSERT_NO_FATAL_FAILURE(expect_the_references_tree(
                soup(triangles, places),
                triangles < 33000 || takes_all_cases() ? ways() : std::vector<BuildOptions>(1)));
}

TEST(RadixBuilders, EqualTheReferenceForEveryCountTo300)
{
    for (uint triangles = 1; triangles <= 300; ++triangles)
        ASSERT_NO_FATAL_FAILURE(expect_the_references_tree(soup(triangles, triangles), {{}}));
}

TEST(RadixBuilders, EqualTheReferenceOnManyTriangles)
{
    const uint many = takes_all_cases() ? 1000003 : 200003;
    ASSERT_NO_FATAL_FAILURE(expect_the_references_tree(soup(many, many), {{}}));
}

/// Trees as deep as their keys allow: a builder that fixes its number of launches in advance must enqueue enough.
TEST(RadixBuilders, EqualTheReferenceOnTheDeepestTreesOfTheirCodes)
{
    for (const uint copies : {1u, 2u, 64u, 1000u}) {
        ASSERT_NO_FATAL_FAILURE(expect_the_references_tree(ladder(10, copies), {{}}));
        ASSERT_NO_FATAL_FAILURE(
            expect_the_references_tree(ladder(21, copies), {{.order = "morton63"}}));
    }
    const Mesh mesh = ladder(21, 64);
    const Input input = upload(bench().device, bench().queue, mesh.points, mesh.faces);
    for (const MakeBuilder make : makers) {
        const auto builder = make(bench().programs, {.order = "morton63"});
        builder->reserve(mesh.faces.size());
        EXPECT_EQ(depth_of(builder->build(input, bench().queue).to_host_tree()), 63 + 6);
        bench().queue.finish();
    }
}

TEST(RadixBuilders, GiveTheSameTreeEveryTime)
{
    const Mesh mesh = soup(20000, 15000);
    for (const MakeBuilder make : makers)
        for (const unsigned group_size : {0u, 64u})
            expect_one_tree(*make(bench().programs, {.group_size = group_size}), mesh);
}

/// Returns the number of launches of a stage that was recorded last.
int launches_of(std::string_view stage)
{
    for (const StageTime& time : bench().queue.finish())
        if (time.stage == stage)
            return time.launches;
    return 0;
}

TEST(RadixBuilders, LaunchOnceForAllLevelsWhereGroupsWait)
{
    const Mesh mesh = soup(1000, 1000);
    const Input input = upload(bench().device, bench().queue, mesh.points, mesh.faces);
    for (const unsigned group_size : {0u, 64u}) {
        const auto builder = make_levels_at_once(bench().programs, {.group_size = group_size});
        builder->reserve(1000);
        const std::uint64_t built = tree_hash(builder->build(input, bench().queue).to_host_tree());
        EXPECT_EQ(launches_of("hierarchy"), 1);
        EXPECT_EQ(tree_hash(builder->refit(input, bench().queue).to_host_tree()), built);
        EXPECT_EQ(launches_of("refit"), 1);
    }
}

}  // namespace
}  // namespace bvhbench
