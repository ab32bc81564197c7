// SPDX-License-Identifier: MIT
#include "harness/sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "geometry/error.h"

namespace bvhbench {
namespace {

/// A builder that only counts: its n-th build takes n nanoseconds.
struct FakeBuild {
    int builds = 0;
    int fails_at = -1;

    std::vector<StageTime> operator()()
    {
        if (builds == fails_at)
            throw Unavailable("out of device memory");
        ++builds;
        return {{"hierarchy", builds, builds, 0, 1, 0}};
    }
};

std::vector<std::int64_t> times_of(const Taken& taken)
{
    std::vector<std::int64_t> times;
    for (const Sample& sample : taken.samples)
        times.push_back(sample.stages.at(0).span_ns);
    return times;
}

TEST(Sampler, KeepsEverySampleAfterTheWarmUpInOrder)
{
    FakeBuild build;
    const std::vector<Timed> cells = {{"fake", std::ref(build)}};
    int order = 0;
    const std::vector<Taken> taken = take_samples(cells, 5, 2, order);
    EXPECT_EQ(times_of(taken[0]), (std::vector<std::int64_t>{3, 4, 5, 6, 7}));
    EXPECT_EQ(build.builds, 7);
    EXPECT_EQ(order, 7);
}

TEST(Sampler, InterleavesCellsAndNumbersTheSamplesOfTheWholeRun)
{
    FakeBuild first;
    FakeBuild second;
    const std::vector<Timed> cells = {{"first", std::ref(first)}, {"second", std::ref(second)}};
    int order = 100;
    const std::vector<Taken> taken = take_samples(cells, 50, 0, order);
    EXPECT_EQ(order, 200);
    std::set<int> orders;
    for (const Taken& cell : taken)
        for (const Sample& sample : cell.samples)
            orders.insert(sample.order);
    EXPECT_EQ(orders.size(), 100u);
    EXPECT_EQ(*orders.begin(), 100);
    // One after the other would be 99 times the same cell as before; at random it is about half.
    EXPECT_GT(taken[0].samples.back().order, 149);
    EXPECT_LT(taken[1].samples.front().order, 150);
}

TEST(Sampler, GoesOnWithTheOthersWhenOneFails)
{
    FakeBuild good;
    FakeBuild bad;
    bad.fails_at = 2;
    const std::vector<Timed> cells = {{"bad", std::ref(bad)}, {"good", std::ref(good)}};
    int order = 0;
    const std::vector<Taken> taken = take_samples(cells, 10, 0, order);
    EXPECT_EQ(taken[0].failure, "out of device memory");
    EXPECT_EQ(bad.builds, 2);
    EXPECT_EQ(taken[1].failure, "");
    EXPECT_EQ(taken[1].samples.size(), 10u);
}

TEST(Sampler, PrintsNothing)
{
    FakeBuild build;
    build.fails_at = 3;
    const std::vector<Timed> cells = {{"fake", std::ref(build)}};
    int order = 0;
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    take_samples(cells, 5, 0, order);
    take_samples({}, 5, 0, order);
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace bvhbench
