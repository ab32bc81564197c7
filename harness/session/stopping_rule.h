// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <numeric>
#include <vector>

#include "harness/choice/sampling.h"
#include "harness/session/sampler.h"

namespace bvhbench {

/// Decides from a cell's times when it has enough samples.
class StoppingRule {
public:
    explicit StoppingRule(const SamplingPlan& plan) : plan_(plan) {}

    /// Adds a sample's time. `counts` is false if the sample was taken during drift.
    void add(double time_ns, bool counts)
    {
        ++taken_;
        if (!counts)
            return;
        times_.push_back(time_ns);
        if (plan_.rules.until > 0 && times_.size() % stride == 0)
            noises_.push_back(relative_quartile_range());
    }

    /// Returns why sampling stops, `elapsed_s` after the warm-up; not_sampled while it continues.
    Stopped verdict(double elapsed_s) const
    {
        if (plan_.rules.until == 0)  // a fixed number includes samples during drift
            return taken_ >= static_cast<std::size_t>(plan_.samples) ? Stopped::number
                                                                     : Stopped::not_sampled;
        // During permanent drift no sample may count in times_. The checks of taken_ below end sampling all the same.
        const auto least = static_cast<std::size_t>(plan_.rules.min_samples);
        if (times_.size() >= least) {
            if (relative_quartile_range() <= plan_.rules.until)
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

private:
    static constexpr std::size_t stride = 8;          ///< samples between two values of the noise
    static constexpr std::size_t looks = 8;           ///< number of last values that must agree
    static constexpr double stable_deviation = 0.05;  ///< largest deviation, relative to the mean

    /// Returns the interquartile range over the median; 0 without samples.
    double relative_quartile_range() const
    {
        const double median = quantile(times_, 0.5);
        return median > 0 ? (quantile(times_, 0.75) - quantile(times_, 0.25)) / median : 0;
    }

    /// True if the last `looks` values of the noise agree, so that more samples would not reduce it.
    bool noise_is_stable() const
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

    const SamplingPlan& plan_;
    std::vector<double> times_;   ///< without samples during drift
    std::size_t taken_ = 0;       ///< all samples
    std::vector<double> noises_;  ///< interquartile range / median, after every `stride` samples
};

}  // namespace bvhbench
