// SPDX-License-Identifier: MIT
#include "harness/base/test_hooks.h"

#include <re2/re2.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "geometry/error.h"

namespace bvhbench {
namespace {

constexpr const char* variable = "BVHBENCH_SLOW";

double factor_of(std::string_view name)
{
    const char* slow = std::getenv(variable);
    std::istringstream entries(slow == nullptr ? "" : slow);
    double product = 1;
    for (std::string entry, of; std::getline(entries, entry, ',');) {
        double factor = 0;
        if (!RE2::FullMatch(entry, "([^:]+):(.+)", &of, &factor) || !(factor > 0 && factor <= 1000))
            throw BadUsage(std::string(variable) +
                           " must be names and factors up to 1000, as oibvh-multi:1.10, not '" +
                           entry + "'");
        product *= of == name ? factor : 1;
    }
    return product;
}

}  // namespace

std::map<std::string, std::string> test_hooks()
{
    factor_of({});  // throws BadUsage for text that cannot be parsed
    const char* slow = std::getenv(variable);
    if (slow == nullptr || *slow == '\0')
        return {};
    return {{variable, slow}};
}

void slow_down(std::span<StageTime> stages, std::string_view name)
{
    const double factor = factor_of(name);
    for (StageTime& stage : stages)
        for (std::int64_t* ns : {&stage.busy_ns, &stage.span_ns, &stage.wall_ns, &stage.start_ns})
            *ns = std::llround(static_cast<double>(*ns) * factor);
}

}  // namespace bvhbench
