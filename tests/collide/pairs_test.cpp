// SPDX-License-Identifier: MIT
#include "collide/pairs.h"

#include <gtest/gtest.h>

#include "geometry/hash.h"

namespace bvhbench {
namespace {

TEST(PairList, IsTheSameWhateverTheOrderPairsWereFoundIn)
{
    const PairList list({{2, 7}, {0, 1}, {2, 3}});
    EXPECT_EQ(list, PairList({{3, 2}, {7, 2}, {1, 0}}));
    EXPECT_EQ(list.hash(), PairList({{3, 2}, {7, 2}, {1, 0}}).hash());
    const std::vector<Pair> canonical = {{0, 1}, {2, 3}, {2, 7}};
    EXPECT_TRUE(
        std::equal(canonical.begin(), canonical.end(), list.pairs().begin(), list.pairs().end()));
    EXPECT_EQ(list.surplus(), 0u);
}

TEST(PairList, CountsPairsFoundTwiceAndTrianglesFoundWithThemselves)
{
    const PairList list({{0, 1}, {1, 0}, {0, 1}, {4, 4}, {1, 2}});
    EXPECT_EQ(list.size(), 2u);
    EXPECT_EQ(list.surplus(), 3u);
}

TEST(PairList, HashIsFnv1aOverLittleEndianWords)
{
    // The published offset basis, and two values computed by a separate program.
    EXPECT_EQ(hex(PairList().hash()), "14650fb0739d0383");
    EXPECT_EQ(hex(PairList({{0, 1}}).hash()), "a803617659589552");
    EXPECT_EQ(hex(PairList({{65536, 258}, {0, 1}}).hash()), "35342af7f7154f02");
    EXPECT_NE(PairList({{0, 2}}).hash(), PairList({{1, 2}}).hash());
}

TEST(PairList, OfMorePairsThanACoreSortsIsSorted)
{
    std::vector<Pair> found;
    for (uint k = 300'000; k-- > 0;)
        found.push_back({(k * 7919) % 1009, 2000 + k});
    const PairList list(found);
    EXPECT_EQ(list.size(), found.size());
    EXPECT_TRUE(std::is_sorted(list.pairs().begin(), list.pairs().end()));
    EXPECT_EQ(facts_of(list.pairs()), facts_of(found));
    found.back() = found.front();
    EXPECT_EQ(PairList(found).surplus(), 1u);
}

TEST(PairFacts, AreThoseOfASetInAnyOrderAndOfNoOther)
{
    const std::vector<Pair> pairs = {{2, 7}, {0, 1}, {2, 3}};
    const auto same = [&](std::vector<Pair> found) { return facts_of(found) == facts_of(pairs); };
    EXPECT_TRUE(same({{3, 2}, {7, 2}, {1, 0}}));
    EXPECT_FALSE(same({{2, 3}, {2, 7}}));                  // one is missing
    EXPECT_FALSE(same({{2, 3}, {2, 7}, {0, 1}, {0, 2}}));  // one too many
    EXPECT_FALSE(same({{2, 3}, {7, 2}, {2, 7}}));          // one twice
    EXPECT_FALSE(same({{2, 3}, {2, 7}, {0, 2}}));          // another one
    EXPECT_FALSE(same({{2, 7}, {0, 3}, {2, 1}}));          // the same ids in other pairs
    EXPECT_EQ(facts_of({}), PairFacts{});
}

TEST(PairFacts, KeepTheirValueFromVersionToVersion)
{
    const PairFacts facts = facts_of(std::vector<Pair>{{0, 1}, {5, 3}});
    EXPECT_EQ(hex(facts.low) + hex(facts.high), "1aea1b7351843f97fe24adce293ebb6d");
}

TEST(Relation, IsBetweenObjectsBeforeItIsAdjacent)
{
    const std::vector<Face> faces = {{0, 1, 2}, {2, 1, 3}, {4, 5, 6}, {3, 7, 8}};
    const std::vector<uint> objects = {0, 0, 0, 1};
    const Family family{faces, objects};
    EXPECT_EQ(relation_of({0, 1}, family), Relation::adjacent);
    EXPECT_EQ(relation_of({0, 2}, family), Relation::apart);
    EXPECT_EQ(relation_of({1, 3}, family), Relation::between_objects);
    EXPECT_EQ(relation_of({1, 3}, {faces, {}}), Relation::adjacent);

    const PairList all({{0, 1}, {0, 2}, {1, 2}, {1, 3}, {0, 3}});
    EXPECT_EQ(selected(all, family, Relation::adjacent), PairList({{0, 1}}));
    EXPECT_EQ(selected(all, family, Relation::apart), PairList({{0, 2}, {1, 2}}));
    EXPECT_EQ(selected(all, family, Relation::between_objects), PairList({{0, 3}, {1, 3}}));
}

}  // namespace
}  // namespace bvhbench
