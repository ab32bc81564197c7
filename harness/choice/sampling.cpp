// SPDX-License-Identifier: MIT
#include "harness/choice/sampling.h"

#include "geometry/error.h"

namespace bvhbench {

void SamplingWords::apply(SamplingRules& rules) const
{
    rules.until = until.value_or(rules.until);
    rules.time_budget_s = time_budget_s.value_or(rules.time_budget_s);
    rules.drift_limit = drift_limit.value_or(rules.drift_limit);
    rules.min_samples = min_samples.value_or(rules.min_samples);
    rules.max_samples = max_samples.value_or(rules.max_samples);
    rules.calibrate_every = calibrate_every.value_or(rules.calibrate_every);
    rules.cold = rules.cold || cold;
    if (rules.until == 0 && (min_samples || max_samples || time_budget_s))
        throw BadUsage(
            "--min-samples, --max-samples and --time-budget bound a search that --until begins; "
            "without it each cell has --samples of them");
    check_rules(rules);
}

void check_rules(const SamplingRules& rules)
{
    if (rules.min_samples > rules.max_samples)
        throw BadUsage("at least " + std::to_string(rules.min_samples) + " samples and at most " +
                       std::to_string(rules.max_samples) + " cannot be: see --min-samples");
}

}  // namespace bvhbench
