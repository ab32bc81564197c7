// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace bvhbench {

/// A sum of doubles that is as if added in twice the precision, whatever the order: what each addition rounds
/// off is kept apart (Neumaier 1974). Needs no number to be smaller than the sum so far, as Kahan's does.
class CompensatedSum {
public:
    void add(double value)
    {
        const double sum = sum_ + value;
        lost_ += std::fabs(sum_) >= std::fabs(value) ? (sum_ - sum) + value : (value - sum) + sum_;
        sum_ = sum;
    }

    double value() const { return sum_ + lost_; }

private:
    double sum_ = 0;
    double lost_ = 0;
};

}  // namespace bvhbench
