// SPDX-License-Identifier: MIT
#include "harness/choice/sampling.h"

#include <algorithm>

#include "geometry/names.h"

namespace bvhbench {

constexpr std::string_view races[] = {"", "whole", "query", "memory"};

constexpr std::string_view caches_names[] = {"hot", "cold", "host"};

std::string_view caches_name(Caches caches)
{
    return caches_names[static_cast<std::size_t>(caches)];
}

Caches caches_called(std::string_view name)
{
    return value_called<Caches>("state of caches", name, caches_names);
}

std::string_view race_name(Race race) { return races[static_cast<std::size_t>(race)]; }

Race race_called(std::string_view name)
{
    return static_cast<Race>(1 + value_called<int>("race", name, std::span(races).subspan(1)));
}

void SamplingWords::apply(SamplingRules& rules) const
{
    rules.until = until.value_or(rules.until);
    rules.time_budget_s = time_budget_s.value_or(rules.time_budget_s);
    rules.energy_s = energy_s.value_or(rules.energy_s);
    rules.drift_limit = drift_limit.value_or(rules.drift_limit);
    rules.min_samples = min_samples.value_or(rules.min_samples);
    rules.max_samples = max_samples.value_or(rules.max_samples);
    rules.calibrate_every = calibrate_every.value_or(rules.calibrate_every);
    rules.race = race.empty() ? rules.race : race_called(race);
    if (!caches.empty())
        rules.caches.clear();
    for (const std::string& name : caches)
        rules.caches.push_back(caches_called(name));
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
    for (const Caches one : rules.caches)
        if (std::count(rules.caches.begin(), rules.caches.end(), one) > 1)
            throw BadUsage("--caches: " + std::string(caches_name(one)) + " is there twice");
    if (rules.race != Race::none &&
        (rules.caches.size() > 1 || rules.caches.front() == Caches::host))
        throw BadUsage("--caches: a race is with hot or with cold ones");
}

}  // namespace bvhbench
