// SPDX-License-Identifier: MIT
//
// For the console only: result files keep samples, and figures compute their own.
#pragma once

#include <vector>

namespace bvhbench {

/// Where the middle and the edges of a set of samples lie.
struct Spread {
    double median = 0, p10 = 0, p90 = 0, q1 = 0, q3 = 0;
};

/// The value a `fraction` of the sorted values lies below, between neighbours in proportion. 0 for none.
double quantile(std::vector<double> values, double fraction);

Spread spread_of(const std::vector<double>& values);

}  // namespace bvhbench
