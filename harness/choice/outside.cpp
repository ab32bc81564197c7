// SPDX-License-Identifier: MIT
#include "harness/choice/outside.h"

#include <sstream>

#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/base/failure.h"
#include "harness/choice/catalog.h"

namespace bvhbench {
namespace {

/// Share of --time-limit that one call may take. It ends before the watchdog's deadline for the whole sample, so that only the
/// plug-in is lost.
constexpr double share_of_limit = 0.95;

std::vector<std::string> plugins_of(const CommonOptions& common)
{
    std::vector<std::string> files = common.plugins;
    std::istringstream words(environment("BVHBENCH_PLUGINS"));
    for (std::string file; std::getline(words, file, ':');)
        if (!file.empty())
            files.push_back(file);
    return files;
}

}  // namespace

std::vector<std::string> start_outside(const CommonOptions& common)
{
    const outside::Limits limits{.call_s = share_of_limit * common.time_limit_s,
                                 .host_bytes = host_memory_facts().given,
                                 .device_bytes = common.memory_limit};
    std::vector<std::string> failures;
    const auto start = [&](const std::string& file, bool is_program) {
        const std::string failure = reason_of_failure(
            [&] { add_outside(outside::described(file, is_program, limits), limits); });
        if (failure.empty())
            return;
        add_broken_outside(failure);
        failures.push_back(failure);
    };
    for (const std::string& file : plugins_of(common))
        start(file, false);
    for (const std::string& file : common.programs)
        start(file, true);
    return failures;
}

void refuse_outside(const CommonOptions& common, const std::string& command)
{
    if (!plugins_of(common).empty() || !common.programs.empty())
        throw BadUsage("'" + command +
                       "' runs this program's own builders and colliders, and what --plugin, "
                       "--program and BVHBENCH_PLUGINS give takes no part: `smoke` and `run "
                       "agreement` judge it");
}

}  // namespace bvhbench
