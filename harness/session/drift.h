// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "harness/base/failure.h"
#include "harness/choice/sampling.h"
#include "harness/record/record.h"
#include "harness/session/sampler.h"

namespace bvhbench {

/// Results of the calibration, in the order of samples.
class Drift {
public:
    Drift(const SamplingPlan& plan, const std::function<std::int64_t()>& calibrate)
        : plan_(plan), calibrate_(plan.rules.calibrate_every > 0 ? calibrate : nullptr)
    {}

    /// Calibrates before the sample number `order` if calibrate_every samples have passed, or always if `must`.
    void calibrate_if_due(int order, bool must = false)
    {
        if (!calibrate_ || (!must && order < next_))
            return;
        next_ = order + plan_.rules.calibrate_every;
        std::int64_t ns = 0;
        if (reason_of_failure([&] { ns = calibrate_(); }).empty()) {
            results_.push_back({order, static_cast<double>(ns)});
        } else {  // samples are taken without calibration
            calibrate_ = nullptr;
            results_.clear();
        }
    }

    /// True if the last calibration is within the drift limit of the median.
    bool is_steady() const { return results_.empty() || !is_off(results_.back().ns, median()); }

    /// Sets calibration_ns and drifted of the samples from the calibrations before and after each.
    void mark(std::vector<Sample>& samples) const
    {
        if (results_.size() < 2)
            return;
        const double usual = median();
        for (Sample& sample : samples) {
            const auto after = std::ranges::upper_bound(results_.begin() + 1, results_.end() - 1,
                                                        sample.order, {}, &Result::order);
            const double before_ns = (after - 1)->ns;
            sample.calibration_ns = std::llround((before_ns + after->ns) / 2);
            sample.drifted = is_off(before_ns, usual) || is_off(after->ns, usual);
        }
    }

private:
    struct Result {
        int order;
        double ns;
    };

    bool is_off(double ns, double usual) const
    {
        return std::fabs(ns / usual - 1) > plan_.rules.drift_limit;
    }

    double median() const
    {
        std::vector<double> all;
        for (const Result& result : results_)
            all.push_back(result.ns);
        return quantile(std::move(all), 0.5);
    }

    const SamplingPlan& plan_;
    std::function<std::int64_t()> calibrate_;
    std::vector<Result> results_;
    int next_ = 0;
};

}  // namespace bvhbench
