// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace bvhbench {

/// A sum of Reals that is as if added in twice the precision, whatever the order: what each addition rounds
/// off is kept apart (Neumaier 1974). Needs no number to be smaller than the sum so far, as Kahan's does.
template <class Real>
class CompensatedSumOf {
public:
    void add(Real value)
    {
        const Real sum = sum_ + value;
        lost_ += std::fabs(sum_) >= std::fabs(value) ? (sum_ - sum) + value : (value - sum) + sum_;
        sum_ = sum;
    }

    Real value() const { return sum_ + lost_; }

private:
    Real sum_ = 0;
    Real lost_ = 0;
};

using CompensatedSum = CompensatedSumOf<double>;

}  // namespace bvhbench
