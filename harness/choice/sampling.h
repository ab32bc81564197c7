// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace bvhbench {

constexpr int most_samples = 1000000;

/// When a cell has samples enough, and under what circumstances they are taken.
struct SamplingRules {
    /// If not 0: samples are taken until the range between their quartiles is at most this share of the median.
    double until = 0;
    int min_samples = 15;
    int max_samples = 1000;
    double time_budget_s = 60;  ///< for all cells that are sampled together, warm-up left out
    bool cold = false;          ///< whether caches are emptied before each sample
    int calibrate_every = 16;   ///< samples between two runs of the calibration kernel; 0: never
    double drift_limit = 0.25;  ///< samples beside one that is off by more of it are marked

    bool operator==(const SamplingRules&) const = default;
};

/// How often each of some cells is sampled.
struct SamplingPlan {
    int samples = 20;  ///< of each cell, where no target is set
    int warm_up = 3;   ///< taken first and thrown away
    SamplingRules rules = {};
};

/// Why a cell has no more samples.
enum class Stopped {
    not_sampled,
    number,  ///< as many as were asked for
    steady,  ///< the target is reached
    noisy,   ///< noise is stable above the target: more samples would not bring it down
    most,    ///< `max_samples`
    budget,  ///< the time is over
    failure
};

/// The word for it in result files: "number".
std::string_view stopped_name(Stopped stopped);

/// What was said on the command line; the rest stays as it was.
struct SamplingWords {
    std::optional<double> until, time_budget_s, drift_limit;
    std::optional<int> min_samples, max_samples, calibrate_every;
    bool cold = false;

    /// Throws BadUsage if the rules would not make sense then.
    void apply(SamplingRules& rules) const;
};

/// Throws BadUsage for rules that make no sense, naming the option.
void check_rules(const SamplingRules& rules);

/// C_inner and C_tri of Aila, Karras and Laine 2013, Eq. (1): what visiting a node and testing a triangle cost,
/// relative to each other. The paper prints none; with theirs, which these are, its Table 4 comes out.
struct NodeCosts {
    double inner = 1.2;
    double triangle = 1.0;

    bool operator==(const NodeCosts&) const = default;
};

}  // namespace bvhbench
