// SPDX-License-Identifier: MIT
#include "harness/session/race.h"

#include "tests/harness/fakes.h"

namespace bvhbench {
namespace {

/// Samples cells with the listed times, whole times being one and a half times as long, in a race.
std::vector<CellSamples> raced(std::vector<ListedTimes> cells, SamplingRules rules = {},
                               std::vector<double> bytes = {})
{
    std::vector<CellToSample> timed;
    for (std::size_t i = 0; i < cells.size(); ++i)
        timed.push_back({"listed", std::ref(cells[i]), {}, bytes.empty() ? 0 : bytes[i]});
    if (rules.race == Race::none)
        rules.race = Race::whole;
    int order = 0;
    return take_samples(timed, {.samples = 20, .warm_up = 0, .rules = rules}, order);
}

TEST(Race, IntervalsOfMediansAreOrderStatisticsOfTheBinomialDistribution)
{
    std::vector<double> values;
    const auto interval = [&](std::size_t count) {
        while (values.size() < count)
            values.insert(values.begin(), static_cast<double>(values.size() + 1));
        return median_interval(values);
    };
    EXPECT_EQ(interval(1).low, 1);
    EXPECT_EQ(interval(5).low, 1);  // too few for 95 %: the range
    EXPECT_EQ(interval(5).high, 5);
    EXPECT_EQ(interval(8).low, 1);
    EXPECT_EQ(interval(9).low, 2);
    EXPECT_EQ(interval(9).high, 8);
    EXPECT_EQ(interval(20).low, 6);
    EXPECT_EQ(interval(20).high, 15);
    EXPECT_EQ(interval(500).low, 228);
    EXPECT_EQ(interval(501).low, 228);
}

TEST(Race, OneFarBehindHasOneSample)
{
    const auto taken = raced({{{1000}}, {{3100}}, {{2900}}});
    EXPECT_EQ(taken[0].stopped, Stopped::number);
    EXPECT_EQ(taken[0].samples.size(), 20u);
    EXPECT_EQ(taken[1].stopped, Stopped::beaten);
    EXPECT_EQ(taken[1].samples.size(), 1u);
    EXPECT_EQ(taken[2].stopped, Stopped::beaten);
    EXPECT_EQ(taken[2].samples.size(), fewest_compared);
}

TEST(Race, EarlierSamplesCountButDoNotDecide)
{
    ListedTimes fast{{1000}}, slow{{4000}};
    std::vector<CellToSample> cells = {{"fast", std::ref(fast)}, {"slow", std::ref(slow)}};
    for (CellToSample& cell : cells)
        cell.earlier = {{7, cell.once()}};
    int order = 0;
    const auto taken =
        take_samples(cells, {.samples = 5, .warm_up = 3, .rules = {.race = Race::whole}}, order);
    EXPECT_EQ(slow.next, 1u + 3 + 1);
    EXPECT_EQ(taken[1].stopped, Stopped::beaten);
    ASSERT_EQ(taken[1].samples.size(), 2u);
    EXPECT_EQ(taken[1].samples[0].order, 7);
    EXPECT_EQ(taken[0].samples.size(), 5u);
    EXPECT_EQ(fast.next, 1u + 3 + 4);
    ListedTimes again{{1000}}, once_fast{{2000, 4000}};
    cells = {{"fast", std::ref(again), {{7, again()}}}, {"other", std::ref(once_fast), {}}};
    cells[1].earlier = {{8, once_fast()}};
    const auto longer =
        take_samples(cells, {.samples = 5, .warm_up = 0, .rules = {.race = Race::whole}}, order);
    EXPECT_EQ(longer[1].samples.size(), 1 + fewest_compared);
    ListedTimes one{{1000}};
    const std::vector<CellToSample> done = {{"one", std::ref(one), {{7, one()}}}};
    EXPECT_EQ(take_samples(done, {.samples = 1, .warm_up = 0}, order)[0].samples.size(), 1u);
}

TEST(Race, ASlowFirstSampleDoesNotLoseTheRace)
{
    // The first sample of the better cell is 2.9 times the other's.
    const auto taken = raced({{{1000}}, {{2900, 900}}});
    EXPECT_EQ(taken[1].stopped, Stopped::number);
    EXPECT_EQ(taken[0].stopped, Stopped::beaten);
    // Its interval would lie above, but its least value does not.
    const Runner best{{1000, 1000, 1000, 1000, 1000, 1000, 1000, 1000, 1000}};
    Runner own{{900, 1200, 1200, 1200, 1200, 1200, 1200, 1200, 1200}};
    EXPECT_FALSE(is_beaten(own, best));
    own.values[0] = 1100;
    EXPECT_TRUE(is_beaten(own, best));
}

TEST(Race, ThoseThatOverlapGoOnToTheMostAllowed)
{
    const auto taken = raced({{{1000, 1100, 1050, 1000, 1100, 1050, 1000, 1100}},
                              {{1050, 1000, 1100, 1050, 1000, 1100, 1050, 1000}}},
                             {.until = 0.01, .min_samples = 4, .max_samples = 8});
    for (const CellSamples& cell : taken) {
        EXPECT_EQ(cell.stopped, Stopped::most);
        EXPECT_EQ(cell.samples.size(), 8u);
    }
    const auto steady = raced({{{1000}}, {{1000}}}, {.until = 0.05, .min_samples = 4});
    EXPECT_EQ(steady[1].stopped, Stopped::steady);
    EXPECT_EQ(steady[1].samples.size(), 4u);
}

TEST(Race, WithoutARaceNothingIsBeaten)
{
    ListedTimes fast{{1000}}, slow{{9000}};
    EXPECT_EQ(sampled({.samples = 5, .warm_up = 0}, fast, slow)[1].samples.size(), 5u);
}

TEST(Race, OneThatFailsBeatsNobody)
{
    const auto taken = raced({{.times = {}}, {{1000}}});
    EXPECT_EQ(taken[0].stopped, Stopped::failure);
    EXPECT_EQ(taken[1].stopped, Stopped::number);
}

TEST(Race, OfMemoryComparesBytesFirst)
{
    const auto taken = raced({{{100}}, {{1000}}, {{2000}}}, {.race = Race::memory}, {64, 32, 32});
    EXPECT_EQ(taken[0].stopped, Stopped::beaten);
    EXPECT_EQ(taken[0].samples.size(), 1u);
    EXPECT_EQ(taken[1].stopped, Stopped::number);
    EXPECT_EQ(taken[2].stopped, Stopped::beaten);
}

TEST(Race, OfQueriesLeavesTheTreeOut)
{
    const std::vector<StageTime> stages = {{"hierarchy", 70, 70, 0, 1}, {"broad", 20, 20, 0, 1}};
    EXPECT_EQ(raced_ns(Race::query, stages), 20);
    EXPECT_EQ(raced_ns(Race::whole, stages), 90);
    EXPECT_EQ(raced_ns(Race::query, stages, 100), 30);  // by the wall clock
    EXPECT_EQ(raced_ns(Race::whole, stages, 100), 100);
}

}  // namespace
}  // namespace bvhbench
