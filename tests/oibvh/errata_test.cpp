// SPDX-License-Identifier: MIT
//
// Formulas as the paper prints them, compared with correct ones: one test per erratum, listed in docs/paper.md.
//
// The functions named printed_... are transcribed as printed and are wrong on purpose. Nothing else uses them.
#include <gtest/gtest.h>

#include <functional>
#include <numeric>
#include <set>

#include "oibvh/kary_layout.h"
#include "oibvh/layout.h"
#include "tests/oibvh/literal_tree.h"

namespace bvhbench {
namespace {

/// Returns Y_k(L_v) of Eq. (4) and App. C: the exponents of the largest powers that sum to `number`, as a list.
std::vector<uint> exponents(uint number, uint arity)
{
    std::vector<uint> exponents;
    while (number != 0) {
        uint exponent = 0;
        while (kary_power(arity, exponent) <= number / arity)
            ++exponent;
        exponents.push_back(exponent);
        number -= kary_power(arity, exponent);
    }
    return exponents;
}

std::uint64_t literal_virtual_count(const LiteralTree& tree)
{
    return tree.nodes.size() - tree.real_count;
}

/// Returns the sum of a term over the exponents of `virtual_leaves`.
template <class Term>
auto summed(uint virtual_leaves, uint arity, const Term& term)
{
    const std::vector<uint> over = exponents(virtual_leaves, arity);
    return std::transform_reduce(over.begin(), over.end(), decltype(term(0u)){}, std::plus(), term);
}

TEST(Erratum, Equation5sFirstLineTakesPowersForExponents)
{
    // As printed: the sum of 2^(x_k) - 1 over x_k in X, whose members are powers of two already.
    const auto printed_first_line = [](uint virtual_leaves) {
        return summed(virtual_leaves, 2, [](uint y) { return std::exp2(std::exp2(y)) - 1; });
    };
    // With y_k for x_k, the obvious correction: the result is still the trees' leaves minus one each.
    const auto with_y = [](uint y) { return (1u << y) - 1; };
    // With y_k + 1: a perfect tree with 2^y leaves has 2^(y + 1) - 1 nodes. This equals the second line.
    const auto corrected = [](uint y) { return (2u << y) - 1; };
    const auto second_line = [](uint virtual_leaves) {
        return 2 * summed(virtual_leaves, 2, [](uint y) { return 1u << y; }) -
               static_cast<uint>(exponents(virtual_leaves, 2).size());
    };
    EXPECT_EQ(printed_first_line(4), 15);  // four virtual leaves under one node: 7 virtual nodes
    EXPECT_EQ(summed(4, 2, corrected), 7u);
    for (uint leaves = 1; leaves <= 3000; ++leaves) {
        const uint virtual_leaves = oi_shape(leaves).virtual_leaves;
        const auto counted = static_cast<uint>(literal_virtual_count(LiteralTree(leaves, 2)));
        ASSERT_EQ(summed(virtual_leaves, 2, corrected), counted) << leaves;
        ASSERT_EQ(second_line(virtual_leaves), counted) << leaves;
        ASSERT_EQ(printed_first_line(virtual_leaves) == counted, virtual_leaves < 4) << leaves;
        ASSERT_EQ(summed(virtual_leaves, 2, with_y) == counted, virtual_leaves == 0) << leaves;
    }
}

TEST(Erratum, TheFullnessConditionHoldsForNoLevelNotEvenTheRoots)
{
    const auto printed_is_full = [](std::uint64_t leaves, OiShape shape, uint level) {
        return (std::uint64_t{1} << level) <
               2 * (leaves - 1) / (std::uint64_t{1} << shape.leaf_level);
    };
    for (uint leaves = 1; leaves <= 3000; ++leaves)
        for (uint level = 0; level <= oi_shape(leaves).leaf_level; ++level)
            ASSERT_FALSE(printed_is_full(leaves, oi_shape(leaves), level)) << leaves;
    // LayoutOf.SaysOfEveryTreeWhatTheLiteralConstructionSays tests oi_is_full; as a condition on L_v it is:
    for (uint leaves = 1; leaves <= 3000; ++leaves) {
        const OiShape shape = oi_shape(leaves);
        for (uint level = 0; level <= shape.leaf_level; ++level)
            ASSERT_EQ(oi_is_full(shape, level),
                      shape.virtual_leaves < 1u << (shape.leaf_level - level));
    }
}

TEST(Erratum, Equation18CountsFromTheWrongEnd)
{
    const auto printed = [](KaryShape shape, uint level) {
        return shape.virtual_leaves / kary_power(shape.arity, level - 1);
    };
    // As printed, level 1 of a tree has as many virtual nodes as there are virtual leaves.
    const KaryShape shape = kary_shape(5, 3);
    EXPECT_EQ(printed(shape, 1), 4u);  // of three nodes on that level
    EXPECT_EQ(kary_virtual_on(shape, 1), 1u);
    // It disagrees with Eq. (8), which it is said to generalise.
    EXPECT_NE(printed(kary_shape(5, 2), 3), oi_virtual_on(oi_shape(5), 3));
}

TEST(Erratum, Equation17HasAnExponentOneTooSmall)
{
    const auto sum_of = [](uint virtual_leaves, uint arity, uint exponent_more) {
        return summed(virtual_leaves, arity, [=](uint y) {
            return (kary_power(arity, y + exponent_more) - 1) / (arity - 1);
        });
    };
    for (const uint arity : {2u, 3u, 4u, 8u})
        for (uint leaves = 1; leaves <= 600; ++leaves) {
            const uint virtual_leaves = kary_shape(leaves, arity).virtual_leaves;
            const std::uint64_t counted = literal_virtual_count(LiteralTree(leaves, arity));
            ASSERT_EQ(sum_of(virtual_leaves, arity, 0) == counted, virtual_leaves == 0) << leaves;
            ASSERT_EQ(sum_of(virtual_leaves, arity, 1), counted) << leaves;
        }
}

TEST(Erratum, AppendixCsSetOfPowersMustBeReadAsAList)
{
    // k = 3, t = 7: two virtual leaves are two trees of one node, but {1, 1} as a set is {1}.
    const KaryShape shape = kary_shape(7, 3);
    const std::vector<uint> list = exponents(shape.virtual_leaves, 3);
    const std::set<uint> set(list.begin(), list.end());
    EXPECT_EQ(list.size(), 2u);
    EXPECT_EQ(set.size(), 1u);
    EXPECT_EQ(literal_virtual_count(LiteralTree(7, 3)), 2u);
    EXPECT_EQ(kary_virtual_node_count(shape), 2u);
}

TEST(Erratum, Section7sWorstCaseSavesMostOfThePadding)
{
    const auto saved = [](uint leaves) {
        const OiShape shape = oi_shape(leaves);
        return double(oi_virtual_node_count(shape)) / double(oi_perfect_node_count(shape));
    };
    // "The worst case", one past a power of two: half of the perfect tree is not stored. It is the worst case only for the
    // number of support nodes, one on every level but the last.
    const uint power = 1u << 20;
    EXPECT_NEAR(saved(power + 1), 0.5, 1e-4);
    EXPECT_EQ(popcount(oi_shape(power + 1).virtual_leaves), 20u);
    // "A few increments off on the short side from creating a full tree": nothing is saved.
    EXPECT_LT(saved(power - 1), 1e-5);
    EXPECT_LT(saved(power - 3), 1e-5);
}

TEST(Erratum, Equation11sEquivalenceHoldsOnlyForItsWorstCase)
{
    // The number of support nodes is the number of set bits of L_v; log2(t) is its maximum, not its value.
    for (uint bit = 1; bit < 30; ++bit)
        EXPECT_EQ(popcount(oi_shape((1u << bit) + 1).virtual_leaves), bit);
    EXPECT_EQ(popcount(oi_shape(1u << 20).virtual_leaves), 0u);  // log2(t) = 20
    EXPECT_EQ(popcount(oi_shape(2880000).virtual_leaves), 5u);   // log2(t) = 21.5
}

/// Runs Algorithm 1 for one group over the whole tree, work-items in sequence. Returns the number of internal nodes that are
/// written when the loop of line 19 starts `above` levels above the entry level.
std::size_t nodes_written(uint leaves, uint above)
{
    const OiShape shape = oi_shape(leaves);
    const uint entry = shape.leaf_level - 1;
    std::set<uint> written, reached;
    for (uint id = 0; id < oi_real_on(shape, entry); ++id) {
        written.insert(oi_first(entry) + id);                             // lines 2 to 16
        for (uint level = entry + 1 - above; level-- > 0;) {              // lines 19, 20, 32
            const uint node = oi_first(level) + (id >> (entry - level));  // lines 21, 22
            if (oi_is_real(shape, oi_right(node)) && reached.insert(node).second)
                break;             // lines 23, 24
            written.insert(node);  // lines 26 to 31
        }
    }
    return written.size();
}

TEST(Erratum, Algorithm1sLoopMustStartAboveTheEntryLevel)
{
    for (const uint leaves : {4u, 5u, 64u, 100u, 1000u}) {
        const OiShape shape = oi_shape(leaves);
        const uint internal = oi_node_count(shape) - leaves;
        EXPECT_EQ(nodes_written(leaves, 1), internal) << leaves;
        // As printed: only one work-item reaches each entry-level node, so it is the first one there and terminates. The few
        // work-items whose node has no right child continue and end one level above.
        EXPECT_LT(nodes_written(leaves, 0), internal) << leaves;
    }
    EXPECT_EQ(nodes_written(64, 0), 32u);  // the entry level only
}

TEST(Erratum, AppendixBsThreadCountIsNotAWholeNumberOfGroups)
{
    // Eq. (15): t_2 = t_1 / g_1 = r_2, where t_1 = g_1 ceil(r_1 / g_1). For the bunny and g = 256:
    const uint r1 = 144046, g1 = 256;
    const uint t1 = g1 * divided_up(r1, g1);
    const uint t2 = t1 / g1;
    EXPECT_EQ(t2, 563u);
    EXPECT_LE(g1, t2);       // so Eq. (16) keeps g_2 = g_1,
    EXPECT_NE(t2 % g1, 0u);  // which 563 work-items do not fill; t_3 = t_2 / g_2 is no integer
}

TEST(Erratum, Equations14To16HaveNoEnd)
{
    const auto next_group = [](uint r, uint g, uint t) { return g <= t ? g : 1u << floor_log2(r); };
    // With one node at the entry level, groups have one work-item, and the next step is the same, without end.
    const uint r = 1, g = next_group(1, 256, 1);
    EXPECT_EQ(g, 1u);
    EXPECT_EQ(divided_up(r, g), r);
}

TEST(Erratum, JumpingNLevelsGrowsTheTestTreeByTwoToTheTwoN)
{
    // Sec. 5 prints 2^(2^n). Both nodes of a pair have 2^n descendants n levels down.
    const auto pairs = [](uint n) {
        std::size_t count = 0;
        for (uint a = oi_descendant(0, n, 0); a < oi_descendant(1, n, 0); ++a)
            for (uint b = oi_descendant(0, n, 0); b < oi_descendant(1, n, 0); ++b)
                count += oi_ancestor(a, n) == 0 && oi_ancestor(b, n) == 0 ? 1u : 0u;
        return count;
    };
    for (const uint n : {1u, 2u, 3u})
        EXPECT_EQ(pairs(n), std::size_t{1} << (2 * n));
    EXPECT_NE(pairs(3), std::size_t{1} << (1u << 3));
}

TEST(Table1, NodesAndPaddingFollowFromTheTriangleCounts)
{
    struct Column {
        uint triangles, perfect, radix, oi;
        double perfect_percent, oi_percent;  ///< printed, digits cut off and not rounded
        double perfect_digit, oi_digit;      ///< value of the last printed digit
    };
    for (const Column& column : {Column{144046, 524287, 288091, 288100, 45.05, 3.1e-3, 0.01, 1e-4},
                                 {412669, 1048575, 825337, 825344, 21.2, 8.4e-4, 0.1, 1e-5},
                                 {871306, 2097151, 1742611, 1742621, 16.9, 5.7e-4, 0.1, 1e-5},
                                 {1087474, 4194303, 2174947, 2174957, 48.1, 4.5e-4, 0.1, 1e-5},
                                 {2880000, 8388607, 5759999, 5760004, 31.3, 8.6e-5, 0.1, 1e-6}}) {
        const OiShape shape = oi_shape(column.triangles);
        EXPECT_EQ(oi_perfect_node_count(shape), column.perfect);
        EXPECT_EQ(2 * column.triangles - 1, column.radix);
        EXPECT_EQ(oi_node_count(shape), column.oi);
        EXPECT_NEAR(100.0 * oi_virtual_node_count(shape) / column.perfect, column.perfect_percent,
                    column.perfect_digit);
        EXPECT_NEAR(100.0 * (column.oi - column.radix) / column.radix, column.oi_percent,
                    column.oi_digit);
    }
}

}  // namespace
}  // namespace bvhbench
