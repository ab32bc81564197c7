// SPDX-License-Identifier: MIT
#include "harness/base/test_hooks.h"

#include <re2/re2.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <limits>
#include <sstream>

#include "device/energy.h"
#include "geometry/error.h"
#include "harness/base/common_options.h"

namespace bvhbench {
namespace {

constexpr const char* variable = "BVHBENCH_SLOW";
constexpr const char* stop_variable = "BVHBENCH_STOP";
constexpr const char* copy_variable = "BVHBENCH_COPY_BYTES";
constexpr const char* powercap_variable = "BVHBENCH_POWERCAP";

double factor_of(std::string_view name)
{
    std::istringstream entries(environment(variable));
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

/// Returns true if BVHBENCH_STOP names this stage and rank.
bool stops_at(std::string_view stage, unsigned rank)
{
    const std::string stop = environment(stop_variable);
    if (stop.empty())
        return false;
    std::string name;
    unsigned number = 0;
    if (!RE2::FullMatch(stop, "([a-z]+):(\\d+)", &name, &number))
        throw BadUsage(std::string(stop_variable) +
                       " must be a stage and a rank, as exchange:1, not '" + stop + "'");
    return name == stage && number == rank;
}

}  // namespace

std::map<std::string, std::string> test_hooks()
{
    factor_of({});  // throws BadUsage for text that cannot be parsed
    stops_at({}, 0);
    most_copied();
    std::map<std::string, std::string> set;
    for (const char* name : {variable, stop_variable, powercap_variable})
        if (const std::string value = environment(name); !value.empty())
            set[name] = value;
    return set;
}

void slow_down(std::span<StageTime> stages, std::string_view name)
{
    const double factor = factor_of(name);
    for (StageTime& stage : stages)
        for (std::int64_t* ns : {&stage.busy_ns, &stage.span_ns, &stage.wall_ns, &stage.start_ns})
            *ns = std::llround(static_cast<double>(*ns) * factor);
}

std::size_t most_copied()
{
    const std::string most = environment(copy_variable);
    if (most.empty())
        return std::numeric_limits<std::size_t>::max();
    std::size_t bytes = 0;
    if (!RE2::FullMatch(most, "(\\d+)", &bytes) || bytes < 16)
        throw BadUsage(std::string(copy_variable) + " must be a number of bytes from 16 on, not '" +
                       most + "'");
    return bytes;
}

std::string powercap()
{
    const std::string folder = environment(powercap_variable);
    return folder.empty() ? powercap_of_linux : folder;
}

void stop_at(std::string_view stage, unsigned rank)
{
    if (stops_at(stage, rank))
        std::raise(SIGSTOP);
}

void stop_thread_at(std::string_view stage)
{
    while (stops_at(stage, 0))
        pause();
}

}  // namespace bvhbench
