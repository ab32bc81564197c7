// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bvhbench {

constexpr int most_samples = 1000000;

/// What the cells of a scene or frame race for (harness/session/race.h), if they do.
enum class Race {
    none,    ///< no race: all cells are sampled alike
    whole,   ///< the time of all stages
    query,   ///< the time of the stages after the tree
    memory,  ///< the bytes held; of equal bytes, the time of all stages
};

/// Returns the race's name in experiments and on the command line: "whole". Empty for none.
std::string_view race_name(Race race);

/// Returns the race of that name. Throws BadUsage.
Race race_called(std::string_view name);

/// Where a sample finds its data.
enum class Caches {
    hot,   ///< in the caches, as the previous sample left them
    cold,  ///< in the device's memory: the caches are emptied before
    host,  ///< in the host's memory: it copies the vertices to the device and its answer back
};

/// Returns the name in experiments, result files and on the command line: "hot".
std::string_view caches_name(Caches caches);

/// Returns those of that name. Throws BadUsage.
Caches caches_called(std::string_view name);

/// When sampling of a cell stops, and under which conditions samples are taken.
struct SamplingRules {
    /// If not 0, sampling stops when the interquartile range is at most this fraction of the median.
    double until = 0;
    int min_samples = 15;
    int max_samples = 1000;
    double time_budget_s = 60;  ///< for all cells sampled together, without warm-up
    Race race = Race::none;     ///< whether a cell that is beaten by another stops
    /// Each has cells of its own, sampled one after another by one process.
    std::vector<Caches> caches = {Caches::hot};
    int calibrate_every = 16;  ///< samples between two calibration runs; 0: no calibration
    double energy_s = 0;       ///< seconds that each cell then runs alone, to count joules; 0: none
    double drift_limit = 0.25;  ///< allowed relative deviation of a calibration from the median

    bool operator==(const SamplingRules&) const = default;
};

/// How many samples each of a group of cells gets.
struct SamplingPlan {
    int samples = 20;  ///< per cell, if `rules.until` is 0
    int warm_up = 3;   ///< samples taken first and discarded
    SamplingRules rules = {};
    /// Called after each round with the number of rounds taken, warm-up included; may be empty.
    std::function<void(int)> after_round = {};
};

/// Why sampling of a cell stopped.
enum class Stopped {
    not_sampled,
    number,  ///< the requested number was taken
    steady,  ///< the interquartile range reached the target
    noisy,   ///< the noise is stable above the target: more samples will not help
    most,    ///< `max_samples` were taken
    budget,  ///< the time budget is used up
    beaten,  ///< another cell of the race is better
    failure
};

/// Returns the reason's name in result files: "number".
constexpr std::string_view stopped_name(Stopped stopped)
{
    constexpr std::string_view names[] = {"not_sampled", "number", "steady", "noisy",
                                          "most",        "budget", "beaten", "failure"};
    return names[static_cast<std::size_t>(stopped)];
}

/// Sampling options given on the command line. Options that are not set leave the rules unchanged.
struct SamplingWords {
    std::optional<double> until, time_budget_s, energy_s, drift_limit;
    std::optional<int> min_samples, max_samples, calibrate_every;
    std::string race;
    std::vector<std::string> caches;

    /// Overwrites `rules` with the options that are set. Throws BadUsage if the options or the result contradict each other.
    void apply(SamplingRules& rules) const;
};

/// Throws BadUsage, naming the option, if the bounds contradict each other.
void check_rules(const SamplingRules& rules);

/// Relative costs of visiting an inner node and of testing a triangle: C_inner and C_tri of Aila, Karras and Laine 2013, Eq. (1).
/// [Chitalu2020] prints no values; the defaults, from Aila et al., reproduce its Table 4.
struct NodeCosts {
    double inner = 1.2;
    double triangle = 1.0;

    bool operator==(const NodeCosts&) const = default;
};

}  // namespace bvhbench
