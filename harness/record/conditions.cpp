// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <fstream>

#include "harness/base/table.h"
#include "harness/record/provenance.h"

namespace bvhbench {
namespace {

namespace fs = std::filesystem;

/// Other processes that want to run, per hardware thread, above which they distort times.
constexpr double many_others = 0.25;

constexpr const char* usual_governor = "performance";

/// Returns the first word of a file; empty if there is no such file.
std::string word_in(const fs::path& path)
{
    std::string word;
    std::ifstream(path) >> word;
    return word;
}

/// Returns the entries of `folder` whose names begin with `start`, sorted by name.
std::vector<fs::path> entries(const fs::path& folder, const std::string& start)
{
    std::vector<fs::path> found;
    std::error_code error;
    for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
        if (at->path().filename().string().starts_with(start))
            found.push_back(at->path());
    std::sort(found.begin(), found.end());
    return found;
}

/// Returns the clock's governor of the first core that has another than the usual one, else that.
std::optional<std::string> governor_of(const fs::path& cpus)
{
    std::optional<std::string> governor;
    for (const fs::path& cpu : entries(cpus, "cpu"))
        if (const std::string word = word_in(cpu / "cpufreq/scaling_governor"); !word.empty())
            if (governor.value_or(usual_governor) == usual_governor)
                governor = word;
    return governor;
}

std::optional<bool> turbo_of(const fs::path& cpus)
{
    if (const std::string off = word_in(cpus / "intel_pstate/no_turbo"); !off.empty())
        return off == "0";
    if (const std::string on = word_in(cpus / "cpufreq/boost"); !on.empty())
        return on == "1";
    return std::nullopt;
}

/// Returns whether a laptop's battery is discharging; nothing for hosts without a battery.
std::optional<bool> on_battery(const fs::path& supplies)
{
    std::optional<bool> drawn;
    for (const fs::path& supply : entries(supplies, ""))
        if (word_in(supply / "type") == "Battery" && word_in(supply / "scope") != "Device")
            drawn = drawn.value_or(false) || word_in(supply / "status") == "Discharging";
    return drawn;
}

}  // namespace

Json host_conditions(const std::string& build_type, const fs::path& root)
{
    const fs::path cpus = root / "sys/devices/system/cpu";
    Json found = Json::object(), warnings = Json::array();
    /// Stores a value that is known, and a warning if it `distorts` times.
    const auto put = [&](const char* key, const auto& value, bool distorts, std::string warning) {
        if (value)
            found[key] = *value;
        if (distorts)
            warnings.push_back(std::move(warning));
    };
    if (build_type != "Release")
        warnings.push_back("this is a " + (build_type.empty() ? "untyped" : build_type) +
                           " build: times are those of Release builds only");
    const auto drawn = on_battery(root / "sys/class/power_supply");
    put("on_battery", drawn, drawn.value_or(false), "the host is on battery, which slows it down");
    const auto governor = governor_of(cpus);
    put("governor", governor, governor.value_or(usual_governor) != usual_governor,
        "the clock's governor is " + governor.value_or("") + ", not performance");
    const auto turbo = turbo_of(cpus);
    put("turbo", turbo, turbo.value_or(false),
        "turbo is on: clocks depend on temperature and on what other cores do");
    double load = 0;
    if (std::ifstream(root / "proc/loadavg") >> load)
        found["load"] = load;
    found["warnings"] = std::move(warnings);
    return found;
}

void put_other_processes(Json& conditions, double mean, unsigned threads)
{
    conditions["other_processes"] = std::round(100 * mean) / 100;
    if (mean > many_others * threads)
        conditions["warnings"].push_back(
            "other processes were running between the samples: " + fixed(mean, 1) +
            " on average, on " + std::to_string(threads) + " threads");
}

}  // namespace bvhbench
