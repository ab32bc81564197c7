// SPDX-License-Identifier: MIT
//
// How many cases tests of many combinations take, by the variable BVHBENCH_TESTS: "all" at night (.ci/nightly); "few" on a simulated
// device, which takes seconds to compile (tests/oclgrind.sh); otherwise each value of each parameter, but not each with each.
#pragma once

#include <cstdlib>
#include <initializer_list>
#include <numeric>
#include <string_view>
#include <vector>

namespace bvhbench {

inline bool tests_take(std::string_view how_many)
{
    const char* value = std::getenv("BVHBENCH_TESTS");
    return value != nullptr && value == how_many;
}

inline bool takes_all_cases() { return tests_take("all"); }
inline bool takes_few_cases() { return tests_take("few"); }

/// Whether to take this combination of the values of three or more settings, given by their numbers: at night always, otherwise every
/// other one. Each two values of two settings are together in one that is taken.
inline bool takes_combination(std::initializer_list<int> values)
{
    return takes_all_cases() || std::accumulate(values.begin(), values.end(), 0) % 2 == 0;
}

/// Returns the first `count` values; at night all.
template <class Value>
std::vector<Value> first_by_day(int count, std::initializer_list<Value> values)
{
    return {values.begin(), takes_all_cases() ? values.end() : values.begin() + count};
}

}  // namespace bvhbench
