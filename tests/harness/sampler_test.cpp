// SPDX-License-Identifier: MIT
#include "harness/session/sampler.h"

#include <set>

#include "tests/harness/fakes.h"

namespace bvhbench {
namespace {

/// A builder that only counts: its n-th build reports n nanoseconds, and an impossible time if `bad_each` divides n.
struct FakeBuild {
    int builds = 0;
    int fails_at = -1;
    int bad_each = 0;

    std::vector<StageTime> operator()()
    {
        if (builds == fails_at)
            throw Unavailable("out of device memory");
        if (++builds; bad_each > 0 && builds % bad_each == 0)
            throw BadClock(true, "a launch ended before it began");
        return {{"hierarchy", builds, builds, 0, 1, 0}};
    }
};

using Calibrate = std::function<std::int64_t()>;

/// Samples one cell with the listed times.
CellSamples taken(ListedTimes listed, const SamplingPlan& plan, const Calibrate& calibrate = {})
{
    int order = 0;
    return take_samples(std::vector<CellToSample>{{"listed", std::ref(listed)}}, plan, order,
                        calibrate)
        .at(0);
}

/// Samples one cell with the listed times under `rules`.
CellSamples taken_until(std::vector<std::int64_t> times, SamplingRules rules)
{
    return taken({std::move(times)}, {.samples = 5, .warm_up = 0, .rules = rules});
}

/// Returns `count` times spread evenly around 1000, with quartiles spread / 2 apart.
std::vector<std::int64_t> spread_by(std::int64_t spread, int count)
{
    std::vector<std::int64_t> times;
    for (int i = 0; i < count; ++i)
        times.push_back(1000 + spread * (i % 5 - 2) / 4);
    return times;
}

TEST(Sampler, KeepsEverySampleAfterTheWarmUpInOrder)
{
    FakeBuild build;
    const auto all = sampled({.samples = 5, .warm_up = 2}, build);
    std::vector<std::int64_t> times;
    for (const Sample& sample : all[0].samples)
        times.push_back(sample.stages.at(0).span_ns);
    EXPECT_EQ(times, (std::vector<std::int64_t>{3, 4, 5, 6, 7}));
    EXPECT_EQ(build.builds, 7);
    EXPECT_EQ(all[0].samples.back().order, 6);
}

TEST(Sampler, InterleavesCellsAndNumbersTheSamplesOfTheWholeRun)
{
    FakeBuild first, second;
    const std::vector<CellToSample> cells = {{"first", std::ref(first)},
                                             {"second", std::ref(second)}};
    int order = 100;
    const std::vector<CellSamples> taken =
        take_samples(cells, {.samples = 50, .warm_up = 0}, order);
    EXPECT_EQ(order, 200);
    std::set<int> orders;
    for (const CellSamples& cell : taken)
        for (const Sample& sample : cell.samples)
            orders.insert(sample.order);
    EXPECT_EQ(orders.size(), 100u);
    EXPECT_EQ(*orders.begin(), 100);
    // In sequence, the first cell would end at 149; in random order each cell has samples in both halves.
    EXPECT_GT(taken[0].samples.back().order, 149);
    EXPECT_LT(taken[1].samples.front().order, 150);
}

TEST(Sampler, GoesOnWithTheOthersWhenOneFailsAndPrintsNothing)
{
    FakeBuild good, bad;
    bad.fails_at = 2;
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const std::vector<CellSamples> taken = sampled({.samples = 10, .warm_up = 0}, bad, good);
    EXPECT_TRUE(sampled({.samples = 5, .warm_up = 0}).empty());
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(taken[0].failure, "out of device memory");
    EXPECT_EQ(bad.builds, 2);
    EXPECT_EQ(taken[1].failure, "");
    EXPECT_EQ(taken[1].samples.size(), 10u);
}

TEST(Sampler, TakesEveryCellOnceInEachRound)
{
    FakeBuild first, second, third;
    const auto taken = sampled({.samples = 40, .warm_up = 0}, first, second, third);
    std::set<int> places;  // of the first cell in each round
    for (int round = 0; round < 40; ++round)
        for (const CellSamples& cell : taken) {
            EXPECT_EQ(cell.samples[round].order / 3, round);
            places.insert(taken[0].samples[round].order % 3);
        }
    EXPECT_EQ(places.size(), 3u);
}

TEST(Sampler, StopsAtTheTargetAndNotBeforeTheLeastNumber)
{
    const CellSamples steady = taken_until({1000}, {.until = 0.02, .min_samples = 12});
    EXPECT_EQ(steady.stopped, Stopped::steady);
    EXPECT_EQ(steady.samples.size(), 12u);
    // Twenty scattered samples, then steady ones: the quartiles meet when three quarters of all are steady.
    std::vector<std::int64_t> calming(20);
    for (std::size_t i = 0; i < calming.size(); ++i)
        calming[i] = i % 2 == 0 ? 500 : 2000;
    calming.push_back(1000);
    const CellSamples later = taken_until(calming, {.until = 0.02, .min_samples = 12});
    EXPECT_EQ(later.stopped, Stopped::steady);
    EXPECT_GT(later.samples.size(), 30u);
    EXPECT_LT(later.samples.size(), 60u);
}

TEST(Sampler, SaysHonestlyThatNoiseWillNotGoDown)
{
    const CellSamples noisy = taken_until(spread_by(400, 2000), {.until = 0.02});
    EXPECT_EQ(noisy.stopped, Stopped::noisy);
    EXPECT_GE(noisy.samples.size(), 64u);
    EXPECT_LT(noisy.samples.size(), 200u);
}

TEST(Sampler, StopsAtTheMostAllowedAndWhenTheTimeIsOver)
{
    const CellSamples most = taken_until(spread_by(400, 2000), {.until = 0.02, .max_samples = 30});
    EXPECT_EQ(most.stopped, Stopped::most);
    EXPECT_EQ(most.samples.size(), 30u);
    const CellSamples budget =
        taken_until(spread_by(400, 2000), {.until = 0.02, .time_budget_s = 0});
    EXPECT_EQ(budget.stopped, Stopped::budget);
    EXPECT_EQ(budget.samples.size(), 1u);
    EXPECT_EQ(taken_until({1000}, {}).stopped, Stopped::number);
    EXPECT_EQ(taken_until({1000}, {}).samples.size(), 5u);
}

TEST(Sampler, GoesOnWithThoseThatAreNotSteadyYet)
{
    ListedTimes steady, wild{spread_by(400, 2000)};
    const std::vector<CellToSample> cells = {{"steady", std::ref(steady)},
                                             {"wild", std::ref(wild)}};
    int order = 0;
    const std::vector<CellSamples> taken =
        take_samples(cells, {.warm_up = 2, .rules = {.until = 0.02, .min_samples = 10}}, order);
    EXPECT_EQ(taken[0].samples.size(), 10u);
    EXPECT_EQ(taken[1].stopped, Stopped::noisy);
    EXPECT_EQ(order, static_cast<int>(taken[0].samples.size() + taken[1].samples.size()) + 4);
}

TEST(Sampler, MarksSamplesBesideDriftAndKeepsThem)
{
    int looks = 0;
    const CellSamples marked =
        taken({}, {.samples = 100, .warm_up = 1, .rules = {.calibrate_every = 10}},
              [&]() -> std::int64_t { return ++looks == 5 ? 200 : 100; });
    // Calibrations precede the samples 1, 11, 21, 31, 41, ...; the fifth precedes 41.
    ASSERT_EQ(marked.samples.size(), 100u);
    for (const Sample& sample : marked.samples) {
        EXPECT_EQ(sample.drifted, sample.order >= 31 && sample.order < 51) << sample.order;
        EXPECT_EQ(sample.calibration_ns, sample.drifted ? 150 : 100);
    }
    EXPECT_EQ(looks, 11);
}

TEST(Sampler, DoesNotCountSamplesBesideDriftTowardsATarget)
{
    int looks = 0;
    SamplingRules rules{.until = 0.02, .min_samples = 12, .calibrate_every = 4};
    const CellSamples later = taken({}, {.warm_up = 0, .rules = rules},
                                    [&]() -> std::int64_t { return ++looks == 2 ? 300 : 100; });
    EXPECT_EQ(later.samples.size(), 16u);
    // Sampling must end even if the drift does not.
    rules = {.until = 0.02, .max_samples = 40, .calibrate_every = 4};
    const CellSamples marked = taken({}, {.warm_up = 0, .rules = rules}, [&]() -> std::int64_t {
        ++looks;
        return std::int64_t{100} * looks * looks;
    });
    EXPECT_EQ(marked.stopped, Stopped::most);
    EXPECT_EQ(marked.samples.size(), 40u);
}

TEST(Sampler, GoesOnWithoutACalibrationThatFailsAndMarksNothing)
{
    for (const int fails_at : {1, 3}) {
        int looks = 0;
        const CellSamples unmarked =
            taken({}, {.samples = 40, .warm_up = 0, .rules = {.calibrate_every = 10}},
                  [&]() -> std::int64_t {
                      if (++looks == fails_at)
                          throw Unavailable("no room");
                      return 100 * looks;  // would show drift if it did not fail
                  });
        EXPECT_EQ(looks, fails_at);
        EXPECT_EQ(unmarked.failure, "");
        ASSERT_EQ(unmarked.samples.size(), 40u);
        for (const Sample& sample : unmarked.samples) {
            EXPECT_EQ(sample.calibration_ns, 0) << sample.order;
            EXPECT_FALSE(sample.drifted) << sample.order;
        }
    }
}

TEST(Sampler, DropsAFewSamplesWithImpossibleTimes)
{
    FakeBuild seldom{.bad_each = 20}, often{.bad_each = 5};
    const std::vector<CellSamples> all = sampled({.samples = 50, .warm_up = 1}, seldom, often);
    EXPECT_EQ(all[0].samples.size(), 50u);
    EXPECT_EQ(all[0].dropped, 2);
    EXPECT_EQ(all[0].stopped, Stopped::number);
    EXPECT_EQ(all[1].stopped, Stopped::failure);
    EXPECT_EQ(all[1].failure,
              "2 of 9 samples had impossible times: a launch ended before it began; "
              "--clock host takes the host's");
}

}  // namespace
}  // namespace bvhbench
