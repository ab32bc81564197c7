// SPDX-License-Identifier: MIT
#include "harness/session/race.h"

#include <algorithm>

#include "harness/choice/catalog.h"
#include "harness/session/sampler.h"

namespace bvhbench {
namespace {

constexpr double error = 0.05;  ///< largest probability that a median is outside of its interval

/// Returns the largest k for which fewer than k of `count` values are below their median with a probability of at most error / 2;
/// at least 1.
std::size_t rank_of(std::size_t count)
{
    if (count > 500) {  // by the normal distribution; the terms below would vanish
        const auto whole = static_cast<double>(count);
        return static_cast<std::size_t>((whole - 1.96 * std::sqrt(whole)) / 2);
    }
    double term = std::exp2(-static_cast<double>(count));  // probability of `rank` values below
    double below = term;                                   // of at most so many
    std::size_t rank = 0;
    while (below <= error / 2 && rank < count / 2) {
        ++rank;
        term *= static_cast<double>(count - rank + 1) / static_cast<double>(rank);
        below += term;
    }
    return std::max<std::size_t>(rank, 1);
}

}  // namespace

MedianInterval median_interval(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const std::size_t rank = rank_of(values.size());
    return {values[rank - 1], values[values.size() - rank]};
}

bool is_beaten(const Runner& own, const Runner& best)
{
    if (own.bytes != best.bytes)
        return own.bytes > best.bytes;
    if (own.values.empty() || best.values.empty())
        return false;
    const double least =
        std::min(own.least, *std::min_element(own.values.begin(), own.values.end()));
    const double middle = quantile(best.values, 0.5);
    if (least > far_behind * middle)
        return true;
    return own.values.size() >= fewest_compared && best.values.size() >= fewest_compared &&
           least > middle && median_interval(own.values).low > median_interval(best.values).high;
}

std::size_t best_of(std::span<const Runner> cells)
{
    std::size_t best = cells.size();
    std::pair<double, double> least;  // bytes and median
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::pair own(cells[i].bytes, quantile(cells[i].values, 0.5));
        if (!cells[i].values.empty() && (best == cells.size() || own < least)) {
            best = i;
            least = own;
        }
    }
    return best;
}

bool is_of_query(std::string_view stage)
{
    return stage == "near" || stage == "margin" || stage == "filter" || stage == "ropes" ||
           stage == "pad" || stage == "exact" || stage == "collapse" || stage == "broad" ||
           stage == "copy" || stage == "narrow";
}

double raced_ns(Race race, const std::vector<StageTime>& stages, std::int64_t wall_ns)
{
    const bool by_wall = wall_ns > 0;
    if (race != Race::query)
        return by_wall ? static_cast<double>(wall_ns) : whole_ns(stages);
    double of_query = 0, others = 0;
    for (const StageTime& time : stages)
        (is_of_query(time.stage) ? of_query : others) += static_cast<double>(time.elapsed_ns());
    return by_wall ? static_cast<double>(wall_ns) - others : of_query;
}

double raced_ns(Race race, const Sample& sample)
{
    return raced_ns(race, sample.stages, has_outside() ? sample.wall_ns : 0);
}

}  // namespace bvhbench
