// SPDX-License-Identifier: MIT
#include "harness/ratio_interval.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "harness/statistics.h"

namespace bvhbench {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The largest k with P(Bin(n, 1/2) < k) <= error / 2; 0 if n is too small for that.
std::size_t rank_below(std::size_t n, double error)
{
    const double log_half = -std::log(2.0) * static_cast<double>(n);
    double below = 0;
    for (std::size_t k = 0; k <= n / 2; ++k) {
        const double log_ways = std::lgamma(static_cast<double>(n) + 1) -
                                std::lgamma(static_cast<double>(k) + 1) -
                                std::lgamma(static_cast<double>(n - k) + 1);
        below += std::exp(log_ways + log_half);  // P(Bin <= k)
        if (below > error / 2)
            return k;
    }
    return n / 2;
}

}  // namespace

double samples_per_independent_one(const std::vector<double>& in_order)
{
    const double median = quantile(in_order, 0.5);
    std::vector<double> side;
    for (const double value : in_order)
        side.push_back(value > median ? 1 : value < median ? -1 : 0);
    const std::size_t n = side.size();
    const double variance = std::inner_product(side.begin(), side.end(), side.begin(), 0.0);
    if (!(variance > 0))
        return 1;
    // Two lags at a time, while there is more than noise (after Geyer's initial positive sequence).
    const auto correlation = [&](std::size_t lag) {
        double sum = 0;
        for (std::size_t i = 0; i + lag < n; ++i)
            sum += side[i] * side[i + lag];
        return sum / variance;
    };
    const double noise = std::sqrt(2 / static_cast<double>(n));  // of two lags of independent ones
    double time = 1;
    for (std::size_t lag = 1; lag + 1 <= n / 4; lag += 2) {
        const double pair = correlation(lag) + correlation(lag + 1);
        if (pair <= noise)
            break;
        time += 2 * pair;
    }
    return time;
}

Interval median_interval(const std::vector<double>& in_order, double error)
{
    std::vector<double> sorted = in_order;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t n = sorted.size();
    const double median = quantile(sorted, 0.5);
    if (n == 0)
        return {0, 0, infinite};
    const auto independent =
        static_cast<std::size_t>(static_cast<double>(n) / samples_per_independent_one(in_order));
    const std::size_t rank = rank_below(independent, error);
    if (rank == 0)
        return {0, median, infinite};
    const std::size_t place = rank * n / independent;  // from 1, from either end
    return {sorted[place - 1], median, sorted[n - place]};
}

Interval ratio_interval(const Interval& numerator, const Interval& denominator)
{
    if (!(numerator.value > 0 && denominator.value > 0))
        return {0, 0, infinite};
    const double value = std::log(numerator.value / denominator.value);
    const auto margin = [](double one, double other) { return std::hypot(one, other); };
    const double below = margin(std::log(numerator.value / numerator.low),
                                std::log(denominator.high / denominator.value));
    const double above = margin(std::log(numerator.high / numerator.value),
                                std::log(denominator.value / denominator.low));
    return {std::exp(value - below), std::exp(value), std::exp(value + above)};
}

}  // namespace bvhbench
