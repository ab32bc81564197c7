// SPDX-License-Identifier: MIT
#include "harness/measure/contest.h"

#include <gtest/gtest.h>

namespace bvhbench {
namespace {

using enum Contest::Place;

/// Returns a measured cell with one sample: `before` ns until the leaves, then the tree and the query.
Cell cell(const char* builder, const char* order, const char* collider, std::int64_t before,
          std::int64_t tree, std::int64_t query)
{
    Cell cell;
    cell.builder = {{.order = order}, builder};
    cell.collider.name = collider;
    cell.status = Cell::Status::measured;
    cell.check.verdict = Check::Verdict::agrees;
    cell.samples = {{0,
                     {{"sort", before, before, 0, 1},
                      {"hierarchy", tree, tree, 0, 1},
                      {"broad", query, query, 0, 1}}}};
    return cell;
}

Cell planned(const char* builder, const char* order, const char* collider)
{
    return cell(builder, order, collider, 0, 0, 0);
}

TEST(Contest, WhatTakesLongerThanTheBestInStagesThatAreKnownIsNotRun)
{
    Contest contest(Race::whole);
    contest.compare(cell("oibvh-multi", "morton30", "group", 40, 20, 40));
    EXPECT_EQ(contest.why_not(planned("oibvh-multi", "kd", "group")), "");
    contest.compare(cell("oibvh-multi", "kd", "group", 400, 20, 30));
    EXPECT_NE(contest.why_not(planned("oibvh-multi", "kd", "leaf")), "");
    EXPECT_NE(contest.why_not(planned("oibvh-single", "kd", "leaf")), "");
    // A radix tree has other stages, so nothing is known of it.
    EXPECT_EQ(contest.why_not(planned("karras", "kd", "leaf")), "");
    // Equal trees are queried alike.
    contest.compare(cell("oibvh-multi", "morton30", "leaf", 40, 20, 160));
    EXPECT_NE(contest.why_not(planned("oibvh-single", "morton30", "leaf")), "");
    EXPECT_EQ(contest.why_not(planned("oibvh-single", "morton30", "group")), "");
    // Along another order a query counts a third.
    EXPECT_EQ(contest.why_not(planned("oibvh-single", "hilbert30", "leaf")), "");
    contest.compare(cell("oibvh-multi", "morton30", "bvtt", 40, 20, 460));
    EXPECT_NE(contest.why_not(planned("oibvh-single", "hilbert30", "bvtt")), "");
}

TEST(Contest, OnlyEqualWorkTells)
{
    Contest contest(Race::whole);
    contest.compare(cell("oibvh-multi", "morton30", "group", 40, 20, 40));
    contest.compare(cell("oibvh-multi", "morton30", "leaf", 40, 900, 900));
    Cell other = planned("oibvh-multi", "morton30", "leaf");
    EXPECT_NE(contest.why_not(other), "");
    other.builder.items = 4;  // its hierarchy may be faster, and it queries a tree of its own
    EXPECT_NE(contest.why_not(other), "");  // though along the same order
    other.collider.keep_adjacent = false;
    EXPECT_EQ(contest.why_not(other), "");
}

TEST(Contest, AFrameIsComparedWithItself)
{
    Contest contest(Race::whole);
    contest.compare(cell("oibvh-multi", "morton30", "group", 4, 2, 4));
    contest.end_frame(std::vector{cell("oibvh-multi", "morton30", "group", 4, 2, 4)});
    EXPECT_EQ(contest.compare(cell("oibvh-multi", "morton30", "group", 400, 200, 400)),
              in_the_race);
}

TEST(Contest, OneSlowSampleAloneDoesNotLeaveACellBehind)
{
    Contest contest(Race::whole);
    contest.compare(cell("oibvh-multi", "morton30", "group", 40, 20, 40));
    const Cell slow = cell("karras", "morton30", "group", 40, 220, 60);
    const std::vector<StageTime> quick = {{"broad", 60, 60, 0, 1}, {"hierarchy", 30, 30, 0, 1}};
    EXPECT_EQ(contest.compare(slow, quick), slow_once);
    EXPECT_EQ(contest.compare(slow, slow.samples[0].stages), far_behind);
    EXPECT_EQ(contest.compare(slow), far_behind);
    // Neither does a machine that is slower for a while: the best takes longer now, too.
    EXPECT_EQ(contest.compare(slow, {}, 1.1), in_the_race);
    // What is known of a stage is the least of all runs.
    EXPECT_EQ(contest.why_not(planned("karras", "hilbert30", "leaf")), "");
}

TEST(Contest, WrongCellsAndThoseOfNoRaceTellNothing)
{
    Contest contest(Race::whole), none(Race::none);
    Cell wrong = cell("oibvh-multi", "morton30", "group", 1, 1, 1);
    wrong.check.verdict = Check::Verdict::differs;
    contest.compare(wrong);
    const Cell slow = cell("oibvh-multi", "morton30", "leaf", 900, 900, 900);
    EXPECT_EQ(contest.compare(slow), in_the_race);
    for (Contest* one : {&contest, &none}) {
        one->compare(cell("karras", "morton30", "leaf", 1, 1, 1));
        EXPECT_EQ(one->why_not(slow).empty(), one == &none);
    }
}

TEST(Contest, ARaceForQueriesCountsQueriesOnly)
{
    Contest contest(Race::query);
    contest.compare(cell("oibvh-multi", "morton30", "group", 40, 20, 40));
    contest.compare(cell("oibvh-multi", "kd", "group", 4000, 20, 30));
    EXPECT_EQ(contest.why_not(planned("oibvh-single", "kd", "group")), "");
    EXPECT_EQ(contest.compare(cell("oibvh-multi", "kd", "leaf", 4000, 20, 90)), in_the_race);
    EXPECT_EQ(contest.compare(cell("oibvh-multi", "kd", "leaf", 40, 20, 91)), far_behind);
}

TEST(Contest, WhoIsFarBehindOverTheFramesIsLeftBehind)
{
    Contest contest(Race::whole);
    const auto frame = [](std::int64_t first, std::int64_t second) {
        return std::vector{cell("oibvh-multi", "morton30", "group", 0, 0, first),
                           cell("karras", "morton30", "group", 0, 0, second)};
    };
    contest.end_frame(frame(100, 199));
    EXPECT_EQ(contest.why_lost(0), "");
    EXPECT_EQ(contest.why_lost(1), "");
    contest.end_frame(frame(100, 250));
    EXPECT_EQ(contest.why_lost(0), "");
    EXPECT_NE(contest.why_lost(1).find("2.2 times the time"), std::string::npos)
        << contest.why_lost(1);
}

TEST(Contest, AFirstFrameDecidesOverFrontsAndRefitsOnlyIfNoneFollows)
{
    const std::vector cells = {cell("oibvh-multi", "morton30", "group", 0, 0, 100),
                               cell("karras", "morton30", "front", 0, 0, 900),
                               cell("none", "morton30", "embree-refit", 0, 0, 900)};
    for (const bool has_later_frames : {false, true}) {
        Contest contest(Race::whole, has_later_frames);
        for (const Cell& one : cells)
            contest.compare(one);
        EXPECT_EQ(contest.why_not(planned("karras", "hilbert30", "front")).empty(),
                  has_later_frames);
        contest.end_frame(cells);
        EXPECT_EQ(contest.why_lost(0), "");
        for (const std::size_t k : {1u, 2u})
            EXPECT_EQ(contest.why_lost(k).empty(), has_later_frames) << k;

        ColliderChoice front = cells[1].collider;
        EXPECT_EQ(contest.can_judge(front), !has_later_frames);
        front.update = FrameUpdate::rebuild;
        EXPECT_TRUE(contest.can_judge(front));
    }
}

TEST(Contest, OfMemoryNothingIsKnownBeforeACellIsRun)
{
    Contest contest(Race::memory);
    Cell one = cell("oibvh-multi", "kd", "group", 4000, 20, 30);
    one.counters["memory_bytes"] = 64;
    EXPECT_EQ(bytes_held(one), 64);
    contest.compare(cell("oibvh-multi", "morton30", "group", 1, 1, 1));
    EXPECT_EQ(contest.compare(one), in_the_race);
    EXPECT_EQ(contest.why_not(planned("oibvh-single", "kd", "group")), "");
    Cell other = one;
    other.counters = {{"tree_bytes", 100.0}, {"scratch_bytes", 40.0}};
    EXPECT_EQ(bytes_held(other), 140);
    contest.end_frame(std::vector{one, other});
    EXPECT_NE(contest.why_lost(1).find("2.2 times the memory"), std::string::npos);
}

}  // namespace
}  // namespace bvhbench
