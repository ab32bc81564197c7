// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace bvhbench {

/// What the test of Mann and Whitney says of two samples.
struct MannWhitney {
    double u = 0;  ///< pairs (a, b) with a > b, those that are equal as halves
    double p = 1;  ///< of as uneven a U or more so, either way, if both were from one distribution
};

/// Compare two samples by their ranks alone. Without ties, and with at most 20 of each, p is exact, by counting all
/// orders; else it is the normal approximation's, with the correction for ties and for continuity. Where all values are
/// equal, or a sample is empty, p is 1.
MannWhitney mann_whitney(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace bvhbench
