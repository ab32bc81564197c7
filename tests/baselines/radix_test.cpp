// SPDX-License-Identifier: MIT
//
// Every builder of radix trees builds the oracle's tree bit for bit, for all sizes, group sizes, leaf storage, code widths and
// numbers of equal codes.
#include <cmath>

#include "baselines/radix/delta.h"
#include "geometry/error.h"
#include "tests/baselines/testing.h"

namespace bvhbench {
namespace {

constexpr MakeBuilder makers[] = {make_karras, make_apetrei, make_apetrei_fused, make_lbvh_levels};

/// Returns small triangles at `places` random places, or fewer if there are fewer triangles. Codes repeat if places < triangles.
Mesh soup(uint triangles, uint places)
{
    std::mt19937 random(triangles);
    const auto next = [&] { return static_cast<float>(random() >> 8) / 16777216.0f; };
    Mesh mesh;
    std::vector<Point> at;
    for (uint k = 0; k < std::min(triangles, places); ++k)
        at.push_back({next(), next(), next()});
    for (uint k = 0; k < triangles; ++k) {
        const Point centre = at[random() % at.size()];
        for (int corner = 0; corner < 3; ++corner)
            mesh.points.push_back({centre.x + (places < triangles ? 0 : next() / 16),
                                   centre.y + static_cast<float>(corner) / 32, centre.z});
        mesh.faces.push_back({3 * k, 3 * k + 1, 3 * k + 2});
    }
    return mesh;
}

/// Returns point-like triangles in cells whose codes are 0 (`copies` times) and every power of two. Their radix tree is a chain
/// with one level per bit of the code, which ends in a balanced tree over the copies.
Mesh ladder(int bits_an_axis, uint copies)
{
    std::vector<Point> at(copies, Point{0, 0, 0});
    for (int bit = 0; bit < bits_an_axis; ++bit) {
        const float offset = std::ldexp(1.0f, bit - bits_an_axis);
        at.insert(at.end(), {{offset, 0, 0}, {0, offset, 0}, {0, 0, offset}});
    }
    at.push_back({1, 1, 1});
    Mesh mesh;
    for (const Point& point : at) {
        const auto first = static_cast<uint>(mesh.points.size());
        mesh.points.insert(mesh.points.end(), 3, point);
        mesh.faces.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

std::vector<BuildOptions> ways()
{
    std::vector<BuildOptions> all;
    for (const bool sorted : {false, true})
        for (const unsigned group_size : {0u, 2u, 64u, 256u})
            all.push_back({.group_size = group_size, .sorted_leaves = sorted});
    all.push_back({.order = "morton63"});
    all.push_back({.order = "morton63", .group_size = 64, .sorted_leaves = true});
    return all;
}

void expect_the_references_tree(const Mesh& mesh, const std::vector<BuildOptions>& ways)
{
    const auto triangles = mesh.faces.size();
    const Input input = upload(bench().device, bench().queue, mesh.points, mesh.faces);
    for (const BuildOptions& options : ways) {
        const auto reference = make_radix_reference(bench().programs, options);
        reference->reserve(triangles);
        const HostTree expected = reference->build(input, bench().queue).spelled_out();
        ASSERT_EQ(broken_promise(expected, mesh.points, mesh.faces), "");
        for (const MakeBuilder make : makers) {
            const auto builder = make(bench().programs, options);
            SCOPED_TRACE(std::string(builder->card().name) + ", " + std::to_string(triangles) +
                         " triangles, " + std::string(options.order) + ", groups of " +
                         std::to_string(options.group_size));
            builder->reserve(triangles);
            ASSERT_EQ(builder->footprint(triangles), builder->reserved());
            const Tree& tree = builder->build(input, bench().queue);
            ASSERT_EQ(tree.node_count(), 2 * triangles - 1);
            ASSERT_EQ(tree_hash(tree.spelled_out()), tree_hash(expected));
            builder->build(input, bench().queue, Start::from_sorted_leaves);
            ASSERT_EQ(tree_hash(tree.spelled_out()), tree_hash(expected)) << "the second time";
            bench().queue.finish();
        }
    }
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

TEST(RadixBuilders, EqualTheReferenceOnSmallTreesOfEqualCodes)
{
    for (const uint places : {1u, 3u})
        for (const uint triangles : {2u, 3u, 5u, 64u, 100u})
            ASSERT_NO_FATAL_FAILURE(expect_the_references_tree(soup(triangles, places), ways()));
}

TEST(RadixBuilders, EqualTheReferenceInEveryWayOnLargerTrees)
{
    for (const uint triangles : {511u, 512u, 513u, 1000u, 4097u, 33000u})
        for (const uint places : {triangles, triangles / 8})
            ASSERT_NO_FATAL_FAILURE(expect_the_references_tree(soup(triangles, places), ways()));
}

TEST(RadixBuilders, EqualTheReferenceForEveryCountTo300)
{
    for (uint triangles = 1; triangles <= 300; ++triangles)
        ASSERT_NO_FATAL_FAILURE(expect_the_references_tree(soup(triangles, triangles), {{}}));
}

TEST(RadixBuilders, EqualTheReferenceOnAMillionTriangles)
{
    ASSERT_NO_FATAL_FAILURE(expect_the_references_tree(soup(1000003, 1000003), {{}}));
}

TEST(RadixBuilders, MakeABalancedTreeOfEqualCodes)
{
    const Mesh mesh = soup(4096, 1);
    const Input input = upload(bench().device, bench().queue, mesh.points, mesh.faces);
    for (const MakeBuilder make : makers) {
        const auto builder = make(bench().programs, {});
        builder->reserve(4096);
        EXPECT_EQ(depth_of(builder->build(input, bench().queue).spelled_out()), 12);
        bench().queue.finish();
    }
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
        EXPECT_EQ(depth_of(builder->build(input, bench().queue).spelled_out()), 63 + 6);
        bench().queue.finish();
    }
}

TEST(RadixBuilders, GiveTheSameTreeAHundredTimes)
{
    const Mesh mesh = soup(20000, 15000);
    const Input input = upload(bench().device, bench().queue, mesh.points, mesh.faces);
    for (const MakeBuilder make : makers)
        for (const unsigned group_size : {0u, 64u}) {
            const auto builder = make(bench().programs, {.group_size = group_size});
            builder->reserve(20000);
            const Tree& tree = builder->build(input, bench().queue);
            const std::uint64_t first = tree_hash(tree.spelled_out());
            for (int repeat = 0; repeat < 100; ++repeat) {
                builder->build(input, bench().queue, Start::from_sorted_leaves);
                ASSERT_EQ(tree_hash(tree.spelled_out()), first);
            }
            bench().queue.finish();
        }
}

TEST(RadixBuilders, RefuseAGroupSizeThatIsNoPowerOfTwo)
{
    for (const MakeBuilder make : makers) {
        EXPECT_THROW(make(bench().programs, {.group_size = 48}), BadUsage);
        EXPECT_THROW(make(bench().programs, {.group_size = 1u << 20}), BadUsage);
    }
}

}  // namespace
}  // namespace bvhbench
