// SPDX-License-Identifier: MIT
#include "builders/implicit/schedule.h"

#include <gtest/gtest.h>

#include <vector>

#include "builders/implicit/layout.h"

namespace bvhbench {
namespace {

SubtreeSchedule schedule_for(uint leaves, uint levels_a_launch)
{
    return subtree_schedule(implicit_leaf_level(leaves), levels_a_launch,
                            [&](uint level) { return implicit_used_on(leaves, level); });
}

void expect_each_level_once(uint leaves, uint levels_a_launch)
{
    const SubtreeSchedule schedule = schedule_for(leaves, levels_a_launch);
    std::vector<int> built(implicit_leaf_level(leaves), 0);
    uint unbuilt = implicit_leaf_level(leaves);
    for (uint i = 0; i < schedule.count; ++i) {
        const SubtreeLaunch& launch = schedule.launches[i];
        ASSERT_EQ(launch.entry_level, unbuilt - 1) << "a launch reads the level just built";
        ASSERT_LE(launch.levels, levels_a_launch);
        for (uint level = launch.entry_level + 1 - launch.levels; level <= launch.entry_level;
             ++level)
            ++built[level];
        unbuilt -= launch.levels;

        // The subtrees' roots are exactly the nodes of the launch's last level.
        ASSERT_EQ(launch.subtrees,
                  implicit_used_on(leaves, launch.entry_level + 1 - launch.levels));
    }
    ASSERT_EQ(built, std::vector<int>(built.size(), 1));
}

TEST(SubtreeSchedule, BuildsEveryLevelExactlyOnce)
{
    for (uint levels = 1; levels <= 13; ++levels)
        for (uint leaves = 1; leaves <= 3000; ++leaves)
            ASSERT_NO_FATAL_FAILURE(expect_each_level_once(leaves, levels))
                << leaves << ' ' << levels;
    for (uint level = 12; level <= 31; ++level)
        for (const uint leaves : {(1u << level) - 1, 1u << level, (1u << level) + 1})
            for (uint levels = 1; levels <= 32 && leaves <= (1u << 31); ++levels)
                ASSERT_NO_FATAL_FAILURE(expect_each_level_once(leaves, levels))
                    << leaves << ' ' << levels;
}

TEST(SubtreeSchedule, IsEmptyForOneLeafAndOneLaunchForTwo)
{
    static_assert(subtree_schedule(0, 9, [](uint) { return 1u; }).count == 0);
    EXPECT_EQ(schedule_for(2, 9).count, 1u);
}

TEST(SubtreeSchedule, TakesTheLaunchesThatFollowFromTheGroupSize)
{
    // 2,880,000 leaves give 22 levels to build. Groups of 256 build 9 levels per launch.
    const SubtreeSchedule schedule = schedule_for(2880000, 9);
    ASSERT_EQ(schedule.count, 3u);
    EXPECT_EQ(schedule.launches[0].entry_level, 21u);
    EXPECT_EQ(schedule.launches[0].subtrees, 5625u);
    EXPECT_EQ(schedule.launches[1].entry_level, 12u);
    EXPECT_EQ(schedule.launches[2].levels, 4u);
    EXPECT_EQ(schedule.launches[2].subtrees, 1u);
}

}  // namespace
}  // namespace bvhbench
