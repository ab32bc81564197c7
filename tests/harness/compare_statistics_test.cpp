// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "harness/mann_whitney.h"
#include "harness/ratio_interval.h"

namespace bvhbench {
namespace {

/// Two samples of nine without ties, of which U is `u`: each of b, in ascending order, is put above as many of a as are left.
MannWhitney of_nine(int u)
{
    std::vector<double> a(9), b;
    std::iota(a.begin(), a.end(), 1.0);
    for (int i = 0; i < 9; ++i) {
        const int below = std::min(u, 9);  // of this b: so many of a are larger
        u -= below;
        b.push_back(9.5 - below + 0.01 * i);
    }
    return mann_whitney(a, b);
}

TEST(MannWhitney, GivesWhatScipyDocuments)
{
    // The example of scipy.stats.mannwhitneyu: ages at which diabetes was found in men and women.
    const std::vector<double> men = {19, 22, 16, 29, 24};
    const std::vector<double> women = {20, 11, 17, 12};
    EXPECT_EQ(mann_whitney(men, women).u, 17);
    EXPECT_NEAR(mann_whitney(men, women).p, 14.0 / 126, 1e-12);
    EXPECT_EQ(mann_whitney(women, men).u, 3);
    EXPECT_NEAR(mann_whitney(women, men).p, 14.0 / 126, 1e-12);
}

TEST(MannWhitney, HasTheCriticalValueOfTheTablesForNineOfEach)
{
    for (const int u : {0, 17, 18, 40})
        EXPECT_EQ(of_nine(u).u, u);
    EXPECT_LT(of_nine(17).p, 0.05);
    EXPECT_GT(of_nine(18).p, 0.05);
    EXPECT_NEAR(of_nine(0).p, 2.0 / 48620, 1e-12);
    EXPECT_LT(of_nine(11).p, 0.01);
    EXPECT_GT(of_nine(12).p, 0.01);
}

TEST(MannWhitney, CountsTiesAsHalvesAndCorrectsForThem)
{
    // By hand: ranks 1, 3, 3, 3, 5.5, 5.5, 7, 8; ties 24 + 6; variance 16/12 (9 - 30/56); z = 5 / 3.35942.
    const MannWhitney of = mann_whitney({1, 2, 2, 3}, {2, 3, 4, 5});
    EXPECT_EQ(of.u, 2.5);
    EXPECT_NEAR(of.p, std::erfc(5 / std::sqrt(2 * 16.0 / 12 * (9 - 30.0 / 56))), 1e-12);
    EXPECT_NEAR(of.p, 0.1366, 1e-4);
    EXPECT_EQ(mann_whitney({1, 1, 1}, {1, 1}).p, 1);
    EXPECT_EQ(mann_whitney({}, {1, 2}).p, 1);
}

TEST(MannWhitney, ApproximatesWhatItWouldCount)
{
    std::vector<double> a, b;
    for (int i = 0; i < 20; ++i) {
        a.push_back(i);
        b.push_back(i + 4.5);
    }
    EXPECT_NEAR(mann_whitney(a, b).p, 0.0304, 1e-4);  // counted
    a.push_back(20);                                  // twenty-one are too many to count
    b.push_back(24.5);
    const double u = mann_whitney(a, b).u;
    const double z = (21 * 21 / 2.0 - u - 0.5) / std::sqrt(21 * 21 / 12.0 * 43);
    EXPECT_NEAR(mann_whitney(a, b).p, std::erfc(z / std::sqrt(2)), 1e-12);
    EXPECT_NEAR(mann_whitney(a, b).p, 0.0346, 1e-4);
}

TEST(MannWhitney, RejectsOneInTwentyOfEqualDistributions)
{
    std::mt19937 random(7);
    std::lognormal_distribution<double> times(0, 0.3);
    int rejected = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        std::vector<double> a(30), b(25);
        for (double& value : a)
            value = times(random);
        for (double& value : b)
            value = times(random);
        rejected += mann_whitney(a, b).p < 0.05 ? 1 : 0;
    }
    EXPECT_GT(rejected, 70);
    EXPECT_LT(rejected, 130);
}

std::vector<double> shuffled(int count, unsigned seed = 3)
{
    std::vector<double> values(static_cast<std::size_t>(count));
    std::iota(values.begin(), values.end(), 1.0);
    std::shuffle(values.begin(), values.end(), std::mt19937(seed));
    return values;
}

/// Larger and smaller by turns at random: no two neighbours say the same.
std::vector<double> independent(int count)
{
    for (unsigned seed = 0;; ++seed)
        if (std::vector<double> values = shuffled(count, seed);
            samples_per_independent_one(values) == 1)
            return values;
}

TEST(MedianInterval, HasTheOrderStatisticsOfTheTables)
{
    // Of 95 %: the 2nd and 8th of 9, the 6th and 15th of 20, the 10th and 21st of 30.
    for (const auto& [count, low, high] : {std::tuple{9, 2, 8}, {20, 6, 15}, {30, 10, 21}}) {
        const Interval interval = median_interval(independent(count), 0.05);
        EXPECT_EQ(interval.low, low) << count;
        EXPECT_EQ(interval.high, high) << count;
        EXPECT_EQ(interval.value, (count + 1) / 2.0);
    }
    // Of 99 %: the 8th and 23rd of 30.
    EXPECT_EQ(median_interval(independent(30), 0.01).low, 8);
}

TEST(MedianInterval, HasNoEndsWhereThereAreTooFew)
{
    const Interval interval = median_interval(independent(5), 0.05);  // 2 of 32 orders are outside
    EXPECT_EQ(interval.low, 0);
    EXPECT_TRUE(std::isinf(interval.high));
    EXPECT_EQ(interval.value, 3);
    EXPECT_TRUE(std::isinf(median_interval({}, 0.05).high));
}

TEST(MedianInterval, IsWiderWhereNeighboursSayTheSame)
{
    std::vector<double> drifting(100);
    std::iota(drifting.begin(), drifting.end(), 1.0);
    EXPECT_GT(samples_per_independent_one(drifting), 10);
    EXPECT_LT(samples_per_independent_one(shuffled(1000)), 1.5);
    EXPECT_EQ(samples_per_independent_one(std::vector<double>(50, 2.0)), 1);
    const Interval steady = median_interval(independent(100), 0.05);
    const Interval drift = median_interval(drifting, 0.05);
    EXPECT_EQ(steady.low, 40);
    EXPECT_TRUE(std::isinf(drift.high));
}

TEST(MedianInterval, ContainsTheMedianAsOftenAsItSays)
{
    std::mt19937 random(11);
    std::lognormal_distribution<double> times(0, 0.5);  // of median 1
    int outside = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        std::vector<double> values(40);
        for (double& value : values)
            value = times(random);
        const Interval interval = median_interval(values, 0.05);
        outside += interval.low > 1 || interval.high < 1 ? 1 : 0;
    }
    EXPECT_LT(outside, 130);
    EXPECT_GT(outside, 20);
}

TEST(RatioInterval, AddsMarginsOfLogarithmsAsSquares)
{
    const Interval ratio = ratio_interval({90, 100, 120}, {45, 50, 52});
    EXPECT_DOUBLE_EQ(ratio.value, 2);
    EXPECT_NEAR(ratio.low, 2 * std::exp(-std::hypot(std::log(100 / 90.0), std::log(52 / 50.0))),
                1e-12);
    EXPECT_NEAR(ratio.high, 2 * std::exp(std::hypot(std::log(120 / 100.0), std::log(50 / 45.0))),
                1e-12);
    const Interval exact = ratio_interval({3, 3, 3}, {2, 2, 2});
    EXPECT_EQ(exact.low, exact.high);
    const Interval endless = ratio_interval({0, 3, INFINITY}, {2, 2, 2});
    EXPECT_EQ(endless.low, 0);
    EXPECT_TRUE(std::isinf(endless.high));
    EXPECT_TRUE(std::isinf(ratio_interval({1, 1, 1}, {0, 0, 0}).high));
}

TEST(RatioInterval, ContainsTheRatioAsOftenAsItSays)
{
    std::mt19937 random(13);
    std::lognormal_distribution<double> times(0, 0.3);
    int outside = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        std::vector<double> a(50), b(50);
        for (double& value : a)
            value = times(random);
        for (double& value : b)
            value = 1.5 * times(random);
        const Interval ratio = ratio_interval(median_interval(b, 0.05), median_interval(a, 0.05));
        outside += ratio.low > 1.5 || ratio.high < 1.5 ? 1 : 0;
    }
    EXPECT_LT(outside, 70);
    EXPECT_GT(outside, 10);
}

}  // namespace
}  // namespace bvhbench
