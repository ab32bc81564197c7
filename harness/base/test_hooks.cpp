// SPDX-License-Identifier: MIT
#include "harness/base/test_hooks.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "geometry/error.h"

namespace bvhbench {
namespace {

constexpr const char* slow_variable = "BVHBENCH_SLOW";

double factor_of(const std::string& entry, std::size_t colon)
{
    double factor = 0;
    const char* end = entry.data() + entry.size();
    const char* digits = colon == entry.npos ? end : entry.data() + colon + 1;
    const auto read = std::from_chars(digits, end, factor);
    if (colon == 0 || read.ec != std::errc() || read.ptr != end || !(factor > 0 && factor <= 1000))
        throw BadUsage(std::string(slow_variable) +
                       " must be names and factors up to 1000, as oibvh-multi:1.10, not '" + entry +
                       "'");
    return factor;
}

}  // namespace

std::map<std::string, std::string> test_hooks()
{
    slowed_by({});  // refuses what it cannot read
    const char* slow = std::getenv(slow_variable);
    if (slow == nullptr || *slow == '\0')
        return {};
    return {{slow_variable, slow}};
}

double slowed_by(std::string_view name)
{
    const char* slow = std::getenv(slow_variable);
    std::istringstream entries(slow == nullptr ? "" : slow);
    double factor = 1;
    for (std::string entry; std::getline(entries, entry, ',');) {
        const std::size_t colon = entry.find(':');
        const double by = factor_of(entry, colon);
        factor *= entry.substr(0, colon) == name ? by : 1;
    }
    return factor;
}

void slow_down(std::span<StageTime> stages, double factor)
{
    const auto slower = [factor](std::int64_t& ns) {
        ns = std::llround(static_cast<double>(ns) * factor);
    };
    for (StageTime& stage : stages)
        for (std::int64_t* ns : {&stage.busy_ns, &stage.span_ns, &stage.wall_ns, &stage.start_ns})
            slower(*ns);
}

}  // namespace bvhbench
