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

TEST(HasExactly, HoldsInAnyOrderAndForNothingElse)
{
    const PairList list({{2, 7}, {0, 1}, {2, 3}});
    const auto has = [&](std::vector<Pair> found) { return has_exactly(list, found); };
    EXPECT_TRUE(has({{3, 2}, {7, 2}, {1, 0}}));
    EXPECT_FALSE(has({{2, 3}, {2, 7}}));                  // one is missing
    EXPECT_FALSE(has({{2, 3}, {2, 7}, {0, 1}, {0, 2}}));  // one too many
    EXPECT_FALSE(has({{2, 3}, {7, 2}, {2, 7}}));          // one twice
    EXPECT_FALSE(has({{2, 3}, {2, 7}, {0, 2}}));          // others, with ids
    EXPECT_FALSE(has({{2, 3}, {2, 7}, {1, 7}}));          // below,
    EXPECT_FALSE(has({{2, 3}, {2, 7}, {2, 8}}));          // beside
    EXPECT_FALSE(has({{2, 3}, {2, 7}, {9, 8}}));          // and above those of the list
    EXPECT_TRUE(has_exactly(PairList(), {}));
    EXPECT_FALSE(has_exactly(PairList(), list.pairs()));
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
