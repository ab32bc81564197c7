// SPDX-License-Identifier: MIT
#include "harness/judge/pair_counts.h"

#include <gtest/gtest.h>

#include "collide/narrow/narrow.h"

namespace bvhbench {
namespace {

TEST(PairDifferences, CountWhatIsMissedAndWhatIsFalse)
{
    const auto list = [](std::vector<Pair> pairs) { return PairList(std::move(pairs)); };
    const PairList right = list({{0, 1}, {2, 3}, {4, 5}});
    EXPECT_EQ(differences(right, right), (Differences{0, 0}));
    EXPECT_EQ(differences({}, right), (Differences{3, 0}));
    EXPECT_EQ(differences(right, {}), (Differences{0, 3}));
    EXPECT_EQ(differences(list({{0, 1}, {2, 4}, {4, 5}}), right), (Differences{1, 1}));
    EXPECT_EQ(differences(list({{0, 1}, {6, 7}, {8, 9}}), right), (Differences{2, 2}));
    EXPECT_EQ(differences(list({{0, 1}, {1, 0}, {2, 3}, {4, 5}}), right), (Differences{0, 1}));
}

TEST(PairExamples, NameUpToThreeOfEachKindWithObjectsAndBoxes)
{
    const std::vector<Point> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<Face> faces(8, Face{0, 1, 2});
    const std::vector<uint> file_faces = {10, 11, 12, 13, 14, 15, 16, 17};
    Input input;
    input.points = points;
    input.faces = faces;
    input.objects = {{0, 2}, {2, 6}};
    std::vector<Pair> found = {{7, 6}, {0, 1}, {1, 0}, {1, 0}};
    const std::vector<Pair> doubled = doubled_pairs(found);
    EXPECT_EQ(doubled, (std::vector<Pair>{{0, 1}}));
    const PairList right(std::vector<Pair>{{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 5}});
    const std::string box = ", box 0 0 0 to 1 1 0)";
    const auto pair = [&](const char* a, const char* b) { return a + box + " and " + b + box; };
    EXPECT_EQ(examples(PairList(found), right, doubled, input, file_faces),
              "; 4 missing: " + pair("10 (object 0", "12 (object 1") + ", " +
                  pair("10 (object 0", "13 (object 1") + ", " +
                  pair("10 (object 0", "14 (object 1") +
                  "; 1 extra: " + pair("16 (object 1", "17 (object 1") +
                  "; 2 found twice: " + pair("10 (object 0", "11 (object 0"));
}

TEST(CornerBytes, CountEachFaceAndPointOnce)
{
    const std::vector<Point> points(6);
    const std::vector<Face> faces = {{0, 1, 2}, {1, 2, 3}, {3, 4, 5}, {0, 0, 0}};
    Input input;
    input.points = points;
    input.faces = faces;
    const std::vector<Pair> none, pairs = {{0, 1}, {0, 3}, {1, 3}};
    EXPECT_EQ(corner_bytes(none, input), 0);
    EXPECT_EQ(corner_bytes(pairs, input),
              static_cast<std::int64_t>(3 * sizeof(Face) + 4 * sizeof(Point)));
}

TEST(AddedBytes, GoToTheStageIfItHasLaunches)
{
    std::vector<StageTime> stages = {{.stage = "broad", .launches = 2, .moved_bytes = 10},
                                     {.stage = "broad", .wall_ns = 5},
                                     {.stage = "narrow", .launches = 1, .moved_bytes = 1}};
    add_moved_bytes(stages, "broad", 100);
    EXPECT_EQ(stages[0].moved_bytes, 110);
    EXPECT_EQ(stages[1].moved_bytes, 0);
    EXPECT_EQ(stages[2].moved_bytes, 1);
}

}  // namespace
}  // namespace bvhbench
