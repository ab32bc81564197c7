// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "harness/choice/sampling.h"

namespace bvhbench {

/// The range between the quartiles over the median; 0 of none.
double relative_quartile_range(std::vector<double> times);

/// Decides when a cell has samples enough, from their times as they come.
class StoppingRule {
public:
    explicit StoppingRule(const SamplingPlan& plan) : plan_(plan) {}

    /// A sample has taken so long; `counts` if nothing is known against it. Of `elapsed_s` since the first.
    void add(double time_ns, bool counts);

    /// Why there need be no more; not_sampled while there must.
    Stopped verdict(double elapsed_s);

private:
    /// Whether noise has stayed what it is for so long that it will not go down.
    bool noise_is_stable() const;

    const SamplingPlan& plan_;
    std::vector<double> times_;   ///< that count
    std::size_t taken_ = 0;       ///< with those that do not
    std::vector<double> noises_;  ///< after every `stride` samples
};

}  // namespace bvhbench
