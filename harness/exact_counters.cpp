// SPDX-License-Identifier: MIT
#include "harness/exact_counters.h"

#include <algorithm>
#include <array>

namespace bvhbench {
namespace {

constexpr UnsteadyCounter unsteady[] = {
    {"box_tests_count", "group",
     "it takes nodes in the order in which they turn up, which work-items race for"},
};

}  // namespace

std::span<const UnsteadyCounter> unsteady_counters() { return unsteady; }

bool is_time(std::string_view counter)
{
    constexpr std::array<std::string_view, 5> units = {"_ns", "_us", "_ms", "_s", "_per_s"};
    return std::any_of(units.begin(), units.end(),
                       [&](std::string_view unit) { return counter.ends_with(unit); });
}

bool is_exact(std::string_view counter, const Cell& cell)
{
    return !is_time(counter) &&
           std::none_of(std::begin(unsteady), std::end(unsteady), [&](const UnsteadyCounter& one) {
               return one.counter == counter && one.collider == cell.collider.name;
           });
}

bool depends_on_machine(std::string_view counter)
{
    // Room for as many parts as there are compute units, and for queues that grow in steps of the device's.
    constexpr std::array<std::string_view, 5> sized = {"scratch_bytes", "query_bytes", "near_bytes",
                                                       "narrow_bytes", "memory_bytes"};
    return std::find(sized.begin(), sized.end(), counter) != sized.end();
}

bool is_better_smaller(std::string_view counter)
{
    constexpr std::array<std::string_view, 16> costs = {"sah_cost",
                                                        "sah_inner",
                                                        "sah_leaf",
                                                        "sibling_overlap",
                                                        "depth_max",
                                                        "depth_mean",
                                                        "epo",
                                                        "epo_inner",
                                                        "epo_leaf",
                                                        "nodes_count",
                                                        "missed_count",
                                                        "false_count",
                                                        "missed_pairs_count",
                                                        "false_pairs_count",
                                                        "relative_error",
                                                        "box_tests_count"};
    return counter.ends_with("_bytes") ||
           std::find(costs.begin(), costs.end(), counter) != costs.end();
}

}  // namespace bvhbench
