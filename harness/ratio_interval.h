// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace bvhbench {

/// A value, and between which two the true one is at the confidence asked for. Without enough samples the ends are 0
/// and infinity.
struct Interval {
    double low = 0, value = 0, high = 0;
};

/// By how much more than independent ones values that were taken in this order vary together, about their median: the
/// integrated autocorrelation time of being above it, at least 1. A machine that is slow for a while gives many samples
/// that say one thing.
double samples_per_independent_one(const std::vector<double>& in_order);

/// The median of `in_order`, and the order statistics that it is between with at most `error` of being outside. How far
/// apart they must be is the binomial distribution's, of as many samples as are independent.
Interval median_interval(const std::vector<double>& in_order, double error);

/// The ratio of two quantities that are above 0, from the interval of each, at the error of each: differences of
/// logarithms, whose margins are added as squares (MOVER: Zou and Donner, 2008).
Interval ratio_interval(const Interval& numerator, const Interval& denominator);

}  // namespace bvhbench
