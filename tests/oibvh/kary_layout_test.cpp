// SPDX-License-Identifier: MIT
#include "oibvh/kary_layout.h"

#include <gtest/gtest.h>

#include "oibvh/layout.h"
#include "tests/oibvh/literal_tree.h"

namespace bvhbench {
namespace {

class KaryLayout : public testing::TestWithParam<uint> {
protected:
    const uint arity = GetParam();

    template <class Check>
    void for_every_small_tree(const Check& check) const
    {
        for (uint leaves = 1; leaves <= 2000 && !HasFailure(); ++leaves) {
            SCOPED_TRACE("t = " + std::to_string(leaves));
            check(kary_shape(leaves, arity), LiteralTree(leaves, arity));
        }
    }
};

TEST_P(KaryLayout, SaysOfEveryNodeWhatTheLiteralConstructionSays)
{
    for_every_small_tree([](KaryShape shape, const LiteralTree& literal) {
        ASSERT_EQ(shape.leaf_level + 1, literal.level_count());
        ASSERT_EQ(kary_perfect_node_count(shape), literal.nodes.size());
        ASSERT_EQ(kary_node_count(shape), literal.real_count);
        ASSERT_EQ(kary_virtual_node_count(shape), literal.nodes.size() - literal.real_count);
        for (uint i = 0; i < literal.nodes.size(); ++i) {
            const LiteralTree::Node& node = literal.nodes[i];
            ASSERT_EQ(kary_level(shape, i), node.level) << i;
            ASSERT_EQ(kary_is_real(shape, i), node.real) << i;
            if (node.real) {
                ASSERT_EQ(kary_slot(shape, i), node.slot) << i;
            }
        }
    });
}

TEST_P(KaryLayout, CountsEachLevelAsTheLiteralConstructionDoes)
{
    for_every_small_tree([this](KaryShape shape, const LiteralTree& literal) {
        std::vector<uint> real(literal.level_count(), 0), all(literal.level_count(), 0);
        for (const LiteralTree::Node& node : literal.nodes) {
            ++all[node.level];
            real[node.level] += node.real ? 1u : 0u;
        }
        uint virtual_so_far = 0;
        for (uint level = 0; level < literal.level_count(); ++level) {
            virtual_so_far += all[level] - real[level];
            ASSERT_EQ(kary_first(arity, level), literal.first(level)) << level;
            ASSERT_EQ(kary_real_on(shape, level), real[level]) << level;
            ASSERT_EQ(kary_virtual_on(shape, level), all[level] - real[level]) << level;
            ASSERT_EQ(kary_virtual_up_to(arity, kary_virtual_on(shape, level)), virtual_so_far)
                << level;
            ASSERT_EQ(kary_first_slot(shape, level), literal.nodes[literal.first(level)].slot)
                << level;
        }
    });
}

TEST_P(KaryLayout, RealNodesHaveARealFirstChildAndAtMostOneALevelLacksAny)
{
    for_every_small_tree([this](KaryShape shape, const LiteralTree& literal) {
        std::vector<uint> support(literal.level_count(), 0);
        for (uint i = 0; i < literal.first(shape.leaf_level); ++i) {
            if (!literal.nodes[i].real)
                continue;
            ASSERT_TRUE(kary_is_real(shape, kary_child(arity, i, 1))) << i;
            for (uint j = 1; j <= arity; ++j) {
                ASSERT_EQ(kary_child(arity, i, j), literal.child(i, j - 1)) << i << ' ' << j;
                ASSERT_EQ(kary_parent(arity, kary_child(arity, i, j)), i) << i << ' ' << j;
            }
            if (literal.nodes[i].real_children < arity)
                ++support[literal.nodes[i].level];
        }
        for (const uint count : support)
            ASSERT_LE(count, 1u);
    });
}

TEST_P(KaryLayout, DescendantsAreRepeatedChildren)
{
    for (uint i = 0; i < 20; ++i)
        for (uint n = 0; n <= 4; ++n)
            for (uint m = 0; m < kary_power(arity, n); ++m) {
                uint walked = i;  // m's digits, highest first, say which child
                for (uint step = n; step-- > 0;)
                    walked = kary_child(arity, walked, m / kary_power(arity, step) % arity + 1);
                ASSERT_EQ(kary_descendant(arity, i, n, m), walked) << i << ' ' << n << ' ' << m;
                ASSERT_EQ(kary_ancestor(arity, walked, n), i) << walked << ' ' << n;
            }
}

// In 64 bits, a level at a time, as the definition says: k siblings share a parent.
void expect_wide_agreement(uint leaves, uint arity)
{
    SCOPED_TRACE("t = " + std::to_string(leaves));
    const KaryShape shape = kary_shape(leaves, arity);
    std::vector<std::uint64_t> width = {1};
    while (width.back() < leaves)
        width.push_back(width.back() * arity);
    ASSERT_EQ(shape.leaf_level + 1, width.size());
    std::vector<std::uint64_t> real(width.size(), leaves);
    for (std::size_t level = width.size() - 1; level-- > 0;)
        real[level] = (real[level + 1] + arity - 1) / arity;

    std::uint64_t first = 0, slot = 0;
    for (uint level = 0; level < width.size(); ++level) {
        SCOPED_TRACE("level " + std::to_string(level));
        EXPECT_EQ(kary_first(arity, level), first);
        EXPECT_EQ(kary_real_on(shape, level), real[level]);
        EXPECT_EQ(kary_first_slot(shape, level), slot);
        const auto last_real = static_cast<uint>(first + real[level] - 1);
        EXPECT_EQ(kary_level(shape, last_real), level);
        EXPECT_TRUE(kary_is_real(shape, last_real));
        EXPECT_EQ(kary_slot(shape, last_real), slot + real[level] - 1);
        if (real[level] < width[level]) {
            EXPECT_FALSE(kary_is_real(shape, last_real + 1));
        }
        first += width[level];
        slot += real[level];
    }
    EXPECT_LE(first, 0xffffffffu);
    EXPECT_EQ(kary_perfect_node_count(shape), first);
    EXPECT_EQ(kary_node_count(shape), slot);
}

TEST_P(KaryLayout, HoldsUpToTheMostLeavesThatFit)
{
    const uint most = kary_most_leaves(arity);
    for (const uint leaves : {most, most - 1, most / arity + 1, most / arity, most / 2,
                              most / 2 + 1, (1u << 20) + 1, (1u << 24) - 1, 2880000u})
        expect_wide_agreement(leaves, arity);
    // The bound is the largest: one more level, and the last index does not fit.
    std::uint64_t nodes = 1;
    for (std::uint64_t width = 1; width < most; nodes += width)
        width *= arity;
    EXPECT_LE(nodes, 0xffffffffu);
    EXPECT_GT(nodes * arity + 1, 0xffffffffu);
}

INSTANTIATE_TEST_SUITE_P(Arity, KaryLayout, testing::Values(2u, 3u, 4u, 8u),
                         testing::PrintToStringParamName());

TEST(KaryLayoutOfTwo, IsTheBinaryLayout)
{
    for (uint leaves = 1; leaves <= 2000; ++leaves) {
        const KaryShape kary = kary_shape(leaves, 2);
        const OiShape binary = oi_shape(leaves);
        ASSERT_EQ(kary.leaf_level, binary.leaf_level);
        ASSERT_EQ(kary.virtual_leaves, binary.virtual_leaves);
        ASSERT_EQ(kary_node_count(kary), oi_node_count(binary));
        for (uint i = 0; i < oi_perfect_node_count(binary); ++i) {
            ASSERT_EQ(kary_is_real(kary, i), oi_is_real(binary, i)) << leaves << ' ' << i;
            if (oi_is_real(binary, i)) {
                ASSERT_EQ(kary_slot(kary, i), oi_slot(binary, i)) << leaves << ' ' << i;
            }
        }
    }
    for (const uint leaves : {(1u << 24) + 1, (1u << 30) + 1, (1u << 31) - 1, 1u << 31}) {
        const OiShape binary = oi_shape(leaves);
        const uint last_leaf = oi_first(binary.leaf_level) + leaves - 1;
        EXPECT_EQ(kary_node_count(kary_shape(leaves, 2)), oi_node_count(binary));
        EXPECT_EQ(kary_slot(kary_shape(leaves, 2), last_leaf), oi_slot(binary, last_leaf));
    }
}

}  // namespace
}  // namespace bvhbench
