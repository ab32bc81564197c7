// SPDX-License-Identifier: MIT
//
// The kernels equal the reference bit for bit, for any size, form of kernels and location of the leaves.

#include "builders/parameters.h"
#include "geometry/error.h"
#include "oibvh/oibvh.h"
#include "tests/baselines/testing.h"

namespace bvhbench {
namespace {

/// Returns programs of the same device with groups allowed to wait (implicit.waits).
Programs& waiting_programs()
{
    static Programs& waiting = programs_tuned({{&implicit_waits, 1}});
    return waiting;
}

struct Way {
    MakeBuilder make;
    BuildOptions options;
    bool waits = false;
};

std::vector<Way> ways()
{
    std::vector<Way> all;
    for (const bool sorted : {false, true})
        for (const unsigned group_size : {0u, 2u, 64u, 256u}) {
            if (takes_few_cases() && (group_size == 0 || group_size == 256))
                continue;
            const BuildOptions options{.group_size = group_size, .sorted_leaves = sorted};
            all.push_back({make_oibvh_multi, options});
            all.push_back({make_oibvh_single, options});
            all.push_back({make_perfect, options});
            all.push_back({make_oibvh_single, options, true});
            all.push_back({make_oibvh_single_printed, options});
            all.push_back({make_oibvh_multi_printed, options});
        }
    for (const unsigned items : {2u, 4u, 8u}) {
        if (takes_few_cases() && items != 4)
            continue;
        const BuildOptions options{.group_size = 64, .items = items};
        all.push_back({make_oibvh_multi, options});
        all.push_back({make_oibvh_single, options});
        all.push_back({make_oibvh_single, options, true});
        all.push_back({make_oibvh_single_printed, options});
    }
    return all;
}

/// Expects every builder to build the reference tree over `triangles` triangles, from triangles and from sorted leaves; in the
/// memory of the previous build unless `reserves`.
void expect_all_equal(std::vector<std::unique_ptr<Builder>>& builders, uint triangles,
                      uint seed = 7, bool reserves = true)
{
    const Mesh mesh = random_mesh(triangles, std::identity{}, seed);
    const Input input = upload(bench().device, bench().queue, mesh.points, mesh.faces);
    const HostTree expected = tree_over(make_oibvh_reference, mesh);
    for (std::size_t i = 0; i < builders.size(); ++i) {
        SCOPED_TRACE(std::to_string(triangles) + " triangles, way " + std::to_string(i));
        if (reserves)
            builders[i]->reserve(triangles);
        ASSERT_EQ(builders[i]->footprint(triangles), builders[i]->reserved());
        const Tree& tree = builders[i]->build(input, bench().queue);
        ASSERT_EQ(tree_hash(tree.to_host_tree()), tree_hash(expected));
        builders[i]->build(input, bench().queue, Start::from_sorted_leaves);
        ASSERT_EQ(tree_hash(tree.to_host_tree()), tree_hash(expected)) << "the second time";
        bench().queue.finish();
    }
}

std::vector<std::unique_ptr<Builder>> builders_of(const std::vector<Way>& ways)
{
    std::vector<std::unique_ptr<Builder>> builders;
    for (const Way& way : ways)
        builders.push_back(
            way.make(way.waits ? waiting_programs() : bench().programs, way.options));
    return builders;
}

TEST(ImplicitBuilders, EqualTheReferenceInEveryWayOnSmallTrees)
{
    auto builders = builders_of(ways());
    for (const uint triangles : {1u, 2u, 3u, 4u, 5u, 7u, 8u, 9u, 63u, 64u, 65u, 129u})
        ASSERT_NO_FATAL_FAILURE(expect_all_equal(builders, triangles));
}

/// A node that a build fails to write keeps its value from the previous build, which is of other triangles here.
TEST(ImplicitBuilders, EqualTheReferenceInEveryWayAndKeepNothingOfTheTreeBefore)
{
    auto builders = builders_of(ways());
    for (const uint triangles : {2u, 65u, 511u, 512u, 513u, 1000u, 4097u, 33000u})
        for (uint seed = 0; seed < (triangles > 5000 ? 1 : takes_all_cases() ? 3 : 2); ++seed)
            ASSERT_NO_FATAL_FAILURE(expect_all_equal(builders, triangles, seed, seed == 0));
}

TEST(OiBuilders, EqualTheReferenceForEveryCountTo600AndAroundEveryPowerOfTwo)
{
    auto builders = builders_of({{make_oibvh_multi, {}},
                                 {make_oibvh_single, {}},
                                 {make_oibvh_single_printed, {.group_size = 64}}});
    for (uint triangles = 1; triangles <= 600; ++triangles)
        ASSERT_NO_FATAL_FAILURE(expect_all_equal(builders, triangles));
    for (uint power = 10; power <= (takes_all_cases() ? 20u : 16u); ++power)
        for (const uint triangles : {(1u << power) - 1, 1u << power, (1u << power) + 1})
            ASSERT_NO_FATAL_FAILURE(expect_all_equal(builders, triangles));
}

TEST(OiBuilders, GiveTheSameTreeEveryTime)
{
    const Mesh mesh = random_mesh(20000);
    for (const MakeBuilder make : {make_oibvh_multi, make_oibvh_single, make_oibvh_single_printed})
        expect_one_tree(*make(bench().programs, {}), mesh);
    expect_one_tree(*make_oibvh_single_printed(bench().programs, {.group_size = 64}), mesh);
}

TEST(OiBuilders, RefuseANumberOfItemsThatIsNoPowerOfTwo)
{
    EXPECT_THROW(make_oibvh_multi(bench().programs, {.items = 3}), BadUsage);
    EXPECT_THROW(make_oibvh_multi_printed(bench().programs, {.items = 2}), BadUsage);
}

}  // namespace
}  // namespace bvhbench
