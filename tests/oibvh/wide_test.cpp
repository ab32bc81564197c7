// SPDX-License-Identifier: MIT
//
// Wide trees: the arithmetic is that of Appendix C, and the kernels' result equals the literal construction bit for bit.

#include "geometry/error.h"
#include "oibvh/kary_layout.h"
#include "oibvh/oibvh.h"
#include "oibvh/wide/layout.h"
#include "oibvh/wide/tree.h"
#include "tests/baselines/testing.h"

namespace bvhbench {
namespace {

TEST(WideLayout, IsAppendixCsOfInnerNodes)
{
    // One above a power: every digit of the number of virtual leaves has its maximum.
    std::vector<uint> sizes = {144046,         1087474,        2880000,        4194304,
                               (1u << 24) + 1, (1u << 27) + 1, (1u << 30) - 1, 1u << 30};
    for (uint leaves = 2; leaves < 5000; ++leaves)
        sizes.push_back(leaves);
    for (const uint bits : {2u, 3u})
        for (const uint leaves : sizes) {
            const KaryShape shape = kary_shape(leaves, 1u << bits);
            ASSERT_EQ(wide_leaf_level(leaves, bits), shape.leaf_level) << leaves;
            for (uint level = 0; level <= shape.leaf_level; ++level) {
                ASSERT_EQ(wide_real_on(leaves, bits, level), kary_real_on(shape, level)) << leaves;
                ASSERT_EQ(wide_first_slot(leaves, bits, level), kary_first_slot(shape, level))
                    << leaves << ", level " << level;
            }
            ASSERT_EQ(wide_inner_count(leaves, bits), kary_node_count(shape) - leaves);
        }
}

struct Way {
    const char* name;
    MakeBuilder make;
    uint bits;
};

constexpr Way ways[] = {{"wide4", make_oibvh_wide4, 2}, {"wide8", make_oibvh_wide8, 3}};

/// Builds by definition: rows of nodes from the leaves up, each node over the next `children` nodes of the row below. Returns
/// the boxes of each row, the root's row first.
std::vector<std::vector<Aabb>> literal_rows(std::vector<Aabb> leaves, uint children)
{
    std::vector<std::vector<Aabb>> rows = {std::move(leaves)};
    do {
        const std::vector<Aabb>& below = rows.front();
        std::vector<Aabb> row;
        for (std::size_t first = 0; first < below.size(); first += children) {
            Aabb whole = empty_box();
            for (std::size_t k = first; k < std::min(below.size(), first + children); ++k)
                whole = merged(whole, below[k]);
            row.push_back(whole);
        }
        rows.insert(rows.begin(), std::move(row));
    } while (rows.front().size() > 1);
    return rows;
}

/// Compares a tree, and every box that is stored in its parent, with the literal tree over the reference's leaves.
void expect_literal(const WideTree& tree, const HostTree& reference, const Way& way)
{
    const HostTree found = tree.to_host_tree();
    std::vector<Aabb> leaves;
    std::vector<int> primitives;
    for (const HostTree::Node& node : reference.nodes)  // the last level, from the left
        if (node.primitive != HostTree::none) {
            leaves.push_back(node.box);
            primitives.push_back(node.primitive);
        }
    const std::vector<std::vector<Aabb>> rows = literal_rows(leaves, 1u << way.bits);
    const std::vector<Aabb> stored = tree.stored_boxes(0);
    std::size_t slot = 0;
    for (std::size_t level = 0; level < rows.size(); ++level)
        for (std::size_t k = 0; k < rows[level].size(); ++k, ++slot) {
            const bool is_leaf = level + 1 == rows.size();
            ASSERT_LT(slot, found.nodes.size());
            ASSERT_TRUE(same_bits(found.nodes[slot].box, rows[level][k])) << "slot " << slot;
            ASSERT_EQ(found.nodes[slot].primitive, is_leaf ? primitives[k] : HostTree::none);
            if (level == 0)
                continue;
            const std::size_t parent = slot - k - rows[level - 1].size() + (k >> way.bits);
            ASSERT_TRUE(
                same_bits(stored[(parent << way.bits) + k % (1u << way.bits)], rows[level][k]))
                << "slot " << slot;
        }
    ASSERT_EQ(slot, found.nodes.size());
}

class Wide : public testing::TestWithParam<Way> {
protected:
    void expect_at(uint triangles, float size, const BuildOptions& options)
    {
        SCOPED_TRACE(std::to_string(triangles) + " triangles, groups of " +
                     std::to_string(options.group_size) +
                     (options.sorted_leaves ? ", sorted" : ""));
        const Mesh mesh = random_mesh(triangles, scaled(size));
        const Input input = upload(bench().device, bench().queue, mesh.points, mesh.faces);
        const HostTree expected = tree_over(make_oibvh_reference, mesh);
        const auto builder = GetParam().make(bench().programs, options);
        builder->reserve(triangles);
        ASSERT_EQ(builder->footprint(triangles), builder->reserved());
        const Tree& tree = builder->build(input, bench().queue);
        ASSERT_EQ(invariant_violation(tree.to_host_tree(), mesh.points, mesh.faces), "");
        expect_literal(dynamic_cast<const WideTree&>(tree), expected, GetParam());
        bench().queue.finish();
    }
};

TEST_P(Wide, IsLiteralOfSmallTrees)
{
    for (const uint triangles : {1u, 2u, 3u, 4u, 5u, 7u, 8u, 9u, 16u, 17u, 63u, 64u, 65u, 300u})
        for (const bool sorted : {false, true})
            for (const unsigned group_size : {0u, 8u, 64u})
                expect_at(triangles, 1, {.group_size = group_size, .sorted_leaves = sorted});
}

TEST_P(Wide, IsLiteralOfLargeTreesAndOfOddNumbers)
{
    for (const unsigned group_size : {0u, 64u, 512u}) {
        for (const uint triangles : {511u, 512u, 513u, 4095u, 4097u, 40000u})
            expect_at(triangles, 1, {.group_size = group_size});
        for (const float size : {1e-38f, 1e-42f, 1e30f, 3e38f})
            expect_at(1000, size, {.group_size = group_size});
    }
}

TEST_P(Wide, RefusesMoreTrianglesThanItHasLabelsFor)
{
    const auto builder = GetParam().make(bench().programs, {});
    EXPECT_THROW(builder->footprint((std::size_t{1} << 30) + 1), Unavailable);
}

TEST_P(Wide, TakesLessThanTheBinaryTree)
{
    const std::size_t triangles = 100000;
    const auto binary = make_oibvh_multi(bench().programs, {});
    const auto wide = GetParam().make(bench().programs, {});
    const double bytes = static_cast<double>(wide->footprint(triangles).tree_bytes) / triangles;
    EXPECT_LT(bytes, static_cast<double>(binary->footprint(triangles).tree_bytes) / triangles);
    EXPECT_NEAR(bytes, GetParam().bits == 2 ? 36 : 4 + 192 / 7.0, 0.1);
}

INSTANTIATE_TEST_SUITE_P(Ways, Wide, testing::ValuesIn(ways), CaseName());

}  // namespace
}  // namespace bvhbench
