// SPDX-License-Identifier: MIT
#include "harness/session/stopping.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "harness/session/statistics.h"

namespace bvhbench {
namespace {

constexpr std::size_t stride = 8;          ///< samples between two looks at the noise
constexpr std::size_t looks = 8;           ///< that must agree
constexpr double stable_deviation = 0.05;  ///< of them, as a share of their mean

}  // namespace

double relative_quartile_range(std::vector<double> times)
{
    const double median = quantile(times, 0.5);
    return median > 0 ? (quantile(times, 0.75) - quantile(times, 0.25)) / median : 0;
}

void StoppingRule::add(double time_ns, bool counts)
{
    ++taken_;
    if (!counts)
        return;
    times_.push_back(time_ns);
    if (plan_.rules.until > 0 && times_.size() % stride == 0)
        noises_.push_back(relative_quartile_range(times_));
}

bool StoppingRule::noise_is_stable() const
{
    if (noises_.size() < looks)
        return false;
    const auto first = noises_.end() - static_cast<std::ptrdiff_t>(looks);
    const double mean = std::accumulate(first, noises_.end(), 0.0) / looks;
    double squares = 0;
    for (auto noise = first; noise != noises_.end(); ++noise)
        squares += (*noise - mean) * (*noise - mean);
    return std::sqrt(squares / looks) <= stable_deviation * mean;
}

Stopped StoppingRule::verdict(double elapsed_s)
{
    if (plan_.rules.until == 0)  // a fixed number is what it says, marked ones and all
        return taken_ >= static_cast<std::size_t>(plan_.samples) ? Stopped::number
                                                                 : Stopped::not_sampled;
    // Under a drift that does not end none may count: there is an end to it all the same.
    const auto least = static_cast<std::size_t>(plan_.rules.min_samples);
    if (times_.size() >= least) {
        if (relative_quartile_range(times_) <= plan_.rules.until)
            return Stopped::steady;
        if (noise_is_stable())
            return Stopped::noisy;
    }
    if (taken_ >= static_cast<std::size_t>(plan_.rules.max_samples))
        return Stopped::most;
    if (taken_ > 0 && elapsed_s >= plan_.rules.time_budget_s)
        return Stopped::budget;
    return Stopped::not_sampled;
}

}  // namespace bvhbench
