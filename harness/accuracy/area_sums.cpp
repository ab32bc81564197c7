// SPDX-License-Identifier: MIT
#include "harness/accuracy/area_sums.h"

#include <cmath>
#include <limits>
#include <vector>

#include "harness/judge/compensated_sum.h"
#include "harness/judge/metrics.h"

namespace bvhbench {
namespace {

static_assert(std::numeric_limits<long double>::digits >= 64,
              "the reference must be more precise than what is held to it");

template <class Real>
Real area_in(const Aabb& box)
{
    const Real x = static_cast<Real>(box.max_x) - static_cast<Real>(box.min_x);
    const Real y = static_cast<Real>(box.max_y) - static_cast<Real>(box.min_y);
    const Real z = static_cast<Real>(box.max_z) - static_cast<Real>(box.min_z);
    return 2 * (x * y + y * z + z * x);
}

template <class Real>
class PlainSum {
public:
    void add(Real value) { sum_ += value; }
    Real value() const { return sum_; }

private:
    Real sum_ = 0;
};

/// Sums of 2^k values wait at place k for another of as many.
template <class Real>
class PairwiseSum {
public:
    void add(Real value)
    {
        std::size_t place = 0;
        for (; place < waiting_.size() && is_waiting_[place]; ++place) {
            value += waiting_[place];
            is_waiting_[place] = false;
        }
        if (place == waiting_.size()) {
            waiting_.push_back(0);
            is_waiting_.push_back(false);
        }
        waiting_[place] = value;
        is_waiting_[place] = true;
    }
    Real value() const
    {
        Real sum = 0;
        for (std::size_t place = 0; place < waiting_.size(); ++place)
            if (is_waiting_[place])
                sum += waiting_[place];
        return sum;
    }

private:
    std::vector<Real> waiting_;
    std::vector<char> is_waiting_;
};

template <class Real, class Sum>
Real cost_by(const HostTree& tree)
{
    Sum inner, leaf;
    for (const HostTree::Node& node : tree.nodes)
        (node.primitive != HostTree::none ? leaf : inner).add(area_in<Real>(node.box));
    const NodeCosts costs;
    return (static_cast<Real>(costs.inner) * inner.value() +
            static_cast<Real>(costs.triangle) * leaf.value()) /
           area_in<Real>(tree.nodes.front().box);
}

template <class Real, class Sum>
double cost_as_double(const HostTree& tree)
{
    return static_cast<double>(cost_by<Real, Sum>(tree));
}

// To add a way to sum, add its line here.
constexpr SumMethod catalog[] = {
    {"f32", "areas and one sum in floats", cost_as_double<float, PlainSum<float>>},
    {"f32-pairwise", "the same, sums of sums of two", cost_as_double<float, PairwiseSum<float>>},
    {"f32-compensated", "the same, what is rounded off kept",
     cost_as_double<float, CompensatedSumOf<float>>},
    {"f64", "areas and one sum in doubles", cost_as_double<double, PlainSum<double>>},
    {"f64-pairwise", "the same, sums of sums of two", cost_as_double<double, PairwiseSum<double>>},
    {"f64-compensated", "the same, what is rounded off kept: sah_cost",
     [](const HostTree& tree) { return area_sums(tree)->cost(); }, true},
};

}  // namespace

std::span<const SumMethod> sum_methods() { return catalog; }

long double cost_in_long_double(const HostTree& tree)
{
    return cost_by<long double, CompensatedSumOf<long double>>(tree);
}

}  // namespace bvhbench
