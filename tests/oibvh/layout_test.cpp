// SPDX-License-Identifier: MIT
//
// Both layouts, binary and of any arity, compared with the literal construction and with 64-bit arithmetic.
#include "oibvh/layout.h"

#include "oibvh/layout_check.h"
#include "oibvh/layout_probe.h"
#include "tests/case_name.h"
#include "tests/oibvh/literal_tree.h"

namespace bvhbench {
namespace {

/// The functions of a layout under test.
struct Layout {
    std::string name;
    uint arity;
    LayoutAnswers (*about)(LayoutQuestion);
    uint (*child)(uint arity, uint i, uint j);
    uint (*descendant)(uint arity, uint i, uint n, uint m);
    uint (*ancestor)(uint arity, uint i, uint n);

    LayoutAnswers answers(uint leaves, std::uint64_t node) const
    {
        return about({leaves, arity, static_cast<uint>(node)});
    }
};

std::vector<Layout> layouts()
{
    std::vector<Layout> all = {
        {"binary", 2, oi_answers,
         [](uint, uint i, uint j) { return j == 1 ? oi_left(i) : oi_right(i); },
         [](uint, uint i, uint n, uint m) { return oi_descendant(i, n, m); },
         [](uint, uint i, uint n) { return oi_ancestor(i, n); }}};
    for (const uint arity : {2u, 3u, 4u, 8u})
        all.push_back({"of_" + std::to_string(arity), arity, kary_answers, kary_child,
                       kary_descendant, kary_ancestor});
    return all;
}

class LayoutOf : public testing::TestWithParam<Layout> {
protected:
    const uint arity = GetParam().arity;

    /// Expects the layout to agree with node i of the literal tree, which has `real` nodes on its level.
    void expect_node(const LiteralTree& literal, uint leaves, uint i, std::size_t real) const
    {
        const LiteralTree::Node& node = literal.nodes[i];
        const LayoutAnswers found = GetParam().answers(leaves, i);
        const std::size_t first = literal.first(node.level), last = literal.level_count() - 1;
        const std::size_t all =
            (node.level < last ? literal.first(node.level + 1) : literal.nodes.size()) - first;
        ASSERT_EQ(found.leaf_level, last);
        ASSERT_EQ(found.virtual_leaves, literal.nodes.size() - literal.first(last) - leaves);
        ASSERT_EQ(found.perfect_node_count, literal.nodes.size());
        ASSERT_EQ(found.node_count, literal.real_count);
        ASSERT_EQ(found.virtual_node_count, literal.nodes.size() - literal.real_count);
        ASSERT_EQ(found.level, node.level);
        ASSERT_EQ(found.is_real, node.real ? 1u : 0u);
        ASSERT_EQ(found.slot, node.real ? node.slot : 0u);
        ASSERT_EQ(found.first, first);
        ASSERT_EQ(found.first_slot, literal.nodes[first].slot);
        ASSERT_EQ(found.real_on, real);
        ASSERT_EQ(found.virtual_on, all - real);
        ASSERT_EQ(found.is_full, all == real ? 1u : 0u);
        ASSERT_EQ(found.left, node.level < last ? literal.child(i, 0) : 0u);
        ASSERT_EQ(found.right, node.level < last ? literal.child(i, arity - 1) : 0u);
        ASSERT_EQ(found.parent, i > 0 ? literal.parent(i) : 0u);
        std::size_t leftmost = i, above = i;
        for (std::size_t level = node.level; level < last; ++level)
            leftmost = literal.child(leftmost, 0);
        for (std::size_t step = 0; step < node.level / 2; ++step)
            above = literal.parent(above);
        ASSERT_EQ(found.leftmost_leaf, leftmost);
        ASSERT_EQ(found.half_way_up, above);
    }

    /// Expects agreement with 64-bit arithmetic, level by level, by the definition: `arity` siblings share a parent.
    void expect_wide_agreement(uint leaves) const
    {
        SCOPED_TRACE("t = " + std::to_string(leaves));
        std::vector<std::uint64_t> width = {1};
        while (width.back() < leaves)
            width.push_back(width.back() * arity);
        std::vector<std::uint64_t> real(width.size(), leaves);
        for (std::size_t level = width.size() - 1; level-- > 0;)
            real[level] = (real[level + 1] + arity - 1) / arity;

        std::uint64_t first = 0, slot = 0;
        for (uint level = 0; level < width.size(); ++level) {
            SCOPED_TRACE("level " + std::to_string(level));
            const std::uint64_t last_real = first + real[level] - 1;
            const LayoutAnswers found = GetParam().answers(leaves, last_real);
            EXPECT_EQ(found.leaf_level + 1, width.size());
            EXPECT_EQ(found.first, first);
            EXPECT_EQ(found.real_on, real[level]);
            EXPECT_EQ(found.first_slot, slot);
            EXPECT_EQ(found.level, level);
            EXPECT_EQ(found.is_real, 1u);
            EXPECT_EQ(found.slot, slot + real[level] - 1);
            if (real[level] < width[level]) {
                EXPECT_EQ(GetParam().answers(leaves, last_real + 1).is_real, 0u);
            }
            first += width[level];
            slot += real[level];
        }
        EXPECT_LE(first, 0xffffffffu);
        EXPECT_EQ(GetParam().answers(leaves, 0).perfect_node_count, first);
        EXPECT_EQ(GetParam().answers(leaves, 0).node_count, slot);
    }
};

/// Tests every tree up to 3,000 leaves: up to 600 leaves all nodes, beyond that the ends of each level's real and virtual
/// nodes.
TEST_P(LayoutOf, SaysOfEveryTreeWhatTheLiteralConstructionSays)
{
    for (uint leaves = 1; leaves <= 3000 && !HasFailure(); ++leaves) {
        SCOPED_TRACE("t = " + std::to_string(leaves));
        const LiteralTree literal(leaves, arity);
        std::size_t all_support = 0;
        for (uint first = 0, end = 0; first < literal.nodes.size(); first = end) {
            std::size_t real = 0, support = 0;
            for (end = first; end < literal.nodes.size() &&
                              literal.nodes[end].level == literal.nodes[first].level;
                 ++end) {
                real += literal.nodes[end].real ? 1 : 0;
                support += literal.nodes[end].real && literal.nodes[end].real_children < arity;
            }
            if (end < literal.nodes.size()) {
                ASSERT_LE(support, 1u);
                all_support += support;
            }
            const auto last_real = static_cast<uint>(first + real - 1);
            for (uint i = first; i < end; ++i)
                if (leaves <= 600 || i <= first + 1 || i == last_real || i == last_real + 1 ||
                    i + 1 == end) {
                    ASSERT_NO_FATAL_FAILURE(expect_node(literal, leaves, i, real)) << i;
                }
        }
        // Eq. (7) is 2t - 1 for a tree without support nodes, plus one for each support node.
        if (arity == 2) {
            ASSERT_EQ(all_support, popcount(oi_shape(leaves).virtual_leaves));
        }
    }
}

TEST_P(LayoutOf, HasDescendantsThatAreRepeatedChildren)
{
    const uint most_levels = arity == 2 ? 8 : 4;
    for (uint i = 0; i < 64; ++i)
        for (uint n = 0; n <= most_levels; ++n)
            for (uint m = 0; m < kary_power(arity, n); ++m) {
                uint walked = i;  // m's digits, highest first, select the children
                for (uint step = n; step-- > 0;)
                    walked =
                        GetParam().child(arity, walked, m / kary_power(arity, step) % arity + 1);
                ASSERT_EQ(GetParam().descendant(arity, i, n, m), walked) << i << ' ' << n;
                ASSERT_EQ(GetParam().ancestor(arity, walked, n), i) << walked << ' ' << n;
            }
}

TEST_P(LayoutOf, HoldsUpToTheMostLeavesThatFit)
{
    const uint most = kary_most_leaves(arity);
    for (const uint leaves : {most, most - 1, most / arity + 1, most / arity, most / 2,
                              most / 2 + 1, (1u << 20) + 1, (1u << 24) - 1, 2880000u})
        expect_wide_agreement(leaves);
    // The bound is tight: with one more level, the last index does not fit.
    std::uint64_t nodes = 1;
    for (std::uint64_t width = 1; width < most; nodes += width)
        width *= arity;
    EXPECT_LE(nodes, 0xffffffffu);
    EXPECT_GT(nodes * arity + 1, 0xffffffffu);
}

INSTANTIATE_TEST_SUITE_P(Layouts, LayoutOf, testing::ValuesIn(layouts()), CaseName());

class OiLayoutAt : public testing::TestWithParam<uint> {};

TEST_P(OiLayoutAt, AgreesWithSixtyFourBitArithmetic)
{
    EXPECT_EQ(layout_violation(GetParam()), "");
}

TEST_P(OiLayoutAt, IsHeldToItsNumbers)
{
    OiShape other = oi_shape(GetParam());
    other.virtual_leaves ^= 1u;  // an even number in place of an odd one, or the reverse
    EXPECT_NE(layout_violation(GetParam(), other), "");
    other = oi_shape(GetParam());
    other.leaves -= 1;
    EXPECT_NE(layout_violation(GetParam(), other), "");
}

// Sizes one below, at and one above powers of two, up to the last tree whose indices fit, and the meshes of Table 1.
INSTANTIATE_TEST_SUITE_P(TellingSizes, OiLayoutAt,
                         testing::Values((1u << 20) - 1, 1u << 20, (1u << 20) + 1, (1u << 24) - 1,
                                         1u << 24, (1u << 24) + 1, (1u << 30) - 1, 1u << 30,
                                         (1u << 30) + 1, (1u << 31) - 1, 1u << 31, 144046u, 412669u,
                                         871306u, 1087474u, 2880000u));

TEST(OiLayout, AncestorsAreRepeatedParentsDownToTheLastIndexThatFits)
{
    for (const uint j : {0u, 1u, 2u, 6u, 7u, 2999u, (1u << 24) + 12345u, (1u << 31) - 2u,
                         (1u << 31) - 1u, 0xfffffffdu, 0xfffffffeu}) {
        uint walked = j;
        for (uint n = 0; n <= oi_level(j); ++n) {
            ASSERT_EQ(oi_ancestor(j, n), walked) << j << ' ' << n;
            const uint k = j - oi_descendant(walked, n, 0);
            ASSERT_EQ(oi_descendant(walked, n, k), j) << walked << ' ' << n << ' ' << k;
            if (walked != 0)
                walked = oi_parent(walked);
        }
        EXPECT_EQ(walked, 0u);
    }
}

}  // namespace
}  // namespace bvhbench
