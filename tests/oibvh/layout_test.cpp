// SPDX-License-Identifier: MIT
#include "oibvh/layout.h"

#include <gtest/gtest.h>

#include "oibvh/layout_check.h"
#include "tests/oibvh/literal_tree.h"

namespace bvhbench {
namespace {

constexpr uint last_exhaustive = 3000;

/// Every tree up to `last_exhaustive` leaves, beside its literal construction.
template <class Check>
void for_every_small_tree(const Check& check)
{
    for (uint leaves = 1; leaves <= last_exhaustive && !testing::Test::HasFailure(); ++leaves) {
        SCOPED_TRACE("t = " + std::to_string(leaves));
        check(oi_shape(leaves), LiteralTree(leaves, 2));
    }
}

TEST(OiLayout, SaysOfEveryNodeWhatTheLiteralConstructionSays)
{
    for_every_small_tree([](OiShape shape, const LiteralTree& literal) {
        for (uint i = 0; i < literal.nodes.size(); ++i) {
            const LiteralTree::Node& node = literal.nodes[i];
            ASSERT_EQ(oi_level(i), node.level) << i;
            ASSERT_EQ(oi_is_real(shape, i), node.real) << i;
            if (node.real) {
                ASSERT_EQ(oi_slot(shape, i), node.slot) << i;
            }
        }
    });
}

TEST(OiLayout, CountsNodesAsTheLiteralConstructionDoes)
{
    for_every_small_tree([](OiShape shape, const LiteralTree& literal) {
        ASSERT_EQ(shape.leaf_level + 1, literal.level_count());
        ASSERT_EQ(oi_perfect_node_count(shape), literal.nodes.size());  // Eq. (2)
        ASSERT_EQ(oi_node_count(shape), literal.real_count);            // Eq. (7)
        ASSERT_EQ(oi_virtual_node_count(shape),                         // Eq. (6)
                  literal.nodes.size() - literal.real_count);
        ASSERT_EQ(oi_node_count(shape) + oi_virtual_node_count(shape),  // Eq. (3)
                  oi_perfect_node_count(shape));
    });
}

TEST(OiLayout, CountsEachLevelAsTheLiteralConstructionDoes)
{
    for_every_small_tree([](OiShape shape, const LiteralTree& literal) {
        std::vector<uint> real(literal.level_count(), 0), all(literal.level_count(), 0);
        for (const LiteralTree::Node& node : literal.nodes) {
            ++all[node.level];
            real[node.level] += node.real ? 1u : 0u;
        }
        uint virtual_so_far = 0;
        for (uint level = 0; level < literal.level_count(); ++level) {
            virtual_so_far += all[level] - real[level];
            ASSERT_EQ(oi_first(level), literal.first(level)) << level;
            ASSERT_EQ(oi_real_on(shape, level), real[level]) << level;
            ASSERT_EQ(oi_virtual_on(shape, level), all[level] - real[level]) << level;
            ASSERT_EQ(oi_virtual_up_to(oi_virtual_on(shape, level)), virtual_so_far) << level;
            ASSERT_EQ(oi_first_slot(shape, level), literal.nodes[literal.first(level)].slot)
                << level;
            ASSERT_EQ(oi_is_full(shape, level), all[level] == real[level]) << level;
        }
    });
}

TEST(OiLayout, RealNodesHaveARealLeftChildAndAtMostOneALevelHasNoRightOne)
{
    for_every_small_tree([](OiShape shape, const LiteralTree& literal) {
        std::vector<uint> support(literal.level_count(), 0);
        for (uint i = 0; i < literal.first(shape.leaf_level); ++i) {
            if (!literal.nodes[i].real)
                continue;
            ASSERT_EQ(oi_left(i), literal.child(i, 0));
            ASSERT_EQ(oi_right(i), literal.child(i, 1));
            ASSERT_EQ(oi_parent(oi_left(i)), i);
            ASSERT_EQ(oi_parent(oi_right(i)), i);
            ASSERT_TRUE(oi_is_real(shape, oi_left(i))) << i;
            if (!oi_is_real(shape, oi_right(i)))
                ++support[oi_level(i)];
        }
        uint all_support = 0;
        for (const uint count : support) {
            ASSERT_LE(count, 1u);
            all_support += count;
        }
        // Eq. (7) is 2t - 1 for a tree without support nodes and one more for each.
        ASSERT_EQ(all_support, popcount(shape.virtual_leaves));
    });
}

class OiLayoutAt : public testing::TestWithParam<uint> {};

TEST_P(OiLayoutAt, AgreesWithSixtyFourBitArithmetic) { EXPECT_EQ(broken_layout(GetParam()), ""); }

TEST_P(OiLayoutAt, IsHeldToItsNumbers)
{
    OiShape other = oi_shape(GetParam());
    other.virtual_leaves ^= 1u;  // an even number of virtual leaves where it is odd, and so on
    EXPECT_NE(broken_layout(GetParam(), other), "");
    other = oi_shape(GetParam());
    other.leaves -= 1;
    EXPECT_NE(broken_layout(GetParam(), other), "");
}

// One below, at and above powers of two, up to the last tree whose indices fit, and Table 1's meshes.
INSTANTIATE_TEST_SUITE_P(TellingSizes, OiLayoutAt,
                         testing::Values((1u << 20) - 1, 1u << 20, (1u << 20) + 1, (1u << 24) - 1,
                                         1u << 24, (1u << 24) + 1, (1u << 30) - 1, 1u << 30,
                                         (1u << 30) + 1, (1u << 31) - 1, 1u << 31, 144046u, 412669u,
                                         871306u, 1087474u, 2880000u));

TEST(OiLayout, DescendantsAreRepeatedChildren)
{
    for (uint i = 0; i < 64; ++i)
        for (uint n = 0; n <= 8; ++n)
            for (uint k = 0; k < 1u << n; ++k) {
                uint walked = i;  // k's bits, highest first, say left or right
                for (uint step = n; step-- > 0;)
                    walked = (k >> step & 1u) != 0u ? oi_right(walked) : oi_left(walked);
                ASSERT_EQ(oi_descendant(i, n, k), walked) << i << ' ' << n << ' ' << k;
                ASSERT_EQ(oi_ancestor(walked, n), i) << walked << ' ' << n;
            }
}

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
