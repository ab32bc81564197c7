// SPDX-License-Identifier: MIT
#include "harness/commands/words.h"

#include <re2/re2.h>

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "geometry/error.h"
#include "harness/base/json_keys.h"

namespace bvhbench {
namespace {

constexpr int most_cost = 1000000;
constexpr int most_seconds = 1000000;

/// Parses a number of bytes with an optional unit K, M, G or T (powers of 1024) and an optional B, as in "2G".
std::size_t bytes_of(const std::string& text)
{
    std::uint64_t number = 0;
    std::string unit;
    const bool is_read = RE2::FullMatch(text, "(?i)(\\d+)([KMGT]?)B?", &number, &unit);
    const std::size_t place =
        unit.empty() ? 0 : std::string_view(" kmgt").find(static_cast<char>(unit.front() | 0x20));
    if (!is_read || number == 0 || number > (UINT64_MAX >> (10 * place)))
        throw CLI::ValidationError(
            "--memory-limit",
            "must be a number of bytes from 1 on, as 512M or 2G, not '" + text + "'");
    return number << (10 * place);
}

/// Reads all of `word` as a number and divides it by `unit`. True if the quotient is from 0 to `most`.
bool read_number(std::string_view word, double unit, double most, double& value)
{
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    value /= unit;
    return error == std::errc() && end == word.data() + word.size() && value >= 0 && value <= most;
}

}  // namespace

CLI::Validator a_number(int most)
{
    const auto check = [most](const std::string& word) {
        double value = -1;
        return read_number(word, 1, most, value)
                   ? std::string()
                   : "must be a number from 0 to " + std::to_string(most) + ", not '" + word + "'";
    };
    return {check, "", "a number"};
}

CLI::Validator one_of(std::vector<std::string_view> known)
{
    const auto check = [known = std::move(known)](const std::string& word) {
        return std::find(known.begin(), known.end(), word) != known.end()
                   ? std::string()
                   : "there is no '" + word + "'; there are: " + joined(known);
    };
    return {check, "", "one of"};
}

CLI::Validator a_share(double most)
{
    const auto read = [most](std::string& word) {
        std::string_view digits = word;
        const bool is_percent = digits.ends_with('%');
        digits.remove_suffix(is_percent ? 1 : 0);
        double value = -1;
        if (!read_number(digits, is_percent ? 100 : 1, most, value))
            return "must be a share from 0 to " + std::to_string(static_cast<int>(100 * most)) +
                   "%, as 5% or 0.05, not '" + word + "'";
        word = Json(value).dump();
        return std::string();
    };
    return {read, "", "a share"};
}

void add_common(CLI::App& app, CommonOptions& common)
{
    app.add_option("--device", common.device, "words of its name, or its index in `list devices`");
    app.add_option("--kernels", common.kernels, "a source tree to read kernels from");
    app.add_option("--data", common.data, "the folder of data sets; default: BVHBENCH_DATA");
    app.add_option(
           "--doubles", common.doubles,
           "recentred or as-is: how coordinates of a file that floats cannot hold are rounded")
        ->capture_default_str();
    app.add_option("--tuning", common.tuning,
                   "a folder to read tuned values from, '' for none; default: BVHBENCH_TUNING, "
                   "else those in the program");
    app.add_option_function<std::string>(
        "--memory-limit",
        [&common](const std::string& text) { common.memory_limit = bytes_of(text); },
        "bytes that the program may take in all, and the device, as 512M or 2G; default: all there "
        "are");
    app.add_option("--time-limit", common.time_limit_s,
                   "seconds that a single build or query may take before it is given up; 0: no end")
        ->capture_default_str()
        ->check(a_number(most_seconds));
    app.add_flag("--force", common.force, "replace files that are there, but none that is read");
    app.add_flag("--quiet", common.quiet, "print no tables of results");
    app.add_flag("--verbose", common.verbose, "say on stderr what is being used");
}

void add_sampling(CLI::App& app, SamplingWords& sampling)
{
    app.add_option("--until", sampling.until,
                   "sample each cell until the range between its quartiles is this share of the "
                   "median, as 2%")
        ->transform(a_share(1))
        ->excludes("--samples");
    app.add_option("--min-samples", sampling.min_samples, "with --until: at least so many; 15")
        ->check(CLI::Range(2, most_samples));
    app.add_option("--max-samples", sampling.max_samples, "with --until: at most so many; 1000")
        ->check(CLI::Range(2, most_samples));
    app.add_option("--time-budget", sampling.time_budget_s,
                   "with --until: seconds for the samples of a scene or frame; 60")
        ->check(a_number(most_seconds));
    app.add_option("--race", sampling.race,
                   "whole, query or memory: cells of a scene or frame race for the shortest whole "
                   "or query or the least memory; one that is beaten gets no more samples");
    app.add_flag("--cold", sampling.cold, "empty the device's caches before each sample");
    app.add_option("--calibrate-every", sampling.calibrate_every,
                   "samples between two looks at how fast the device is; 0: none; 16")
        ->check(CLI::Range(0, most_samples));
    app.add_option("--drift-limit", sampling.drift_limit,
                   "mark samples beside a look that is further off its median; 25%")
        ->transform(a_share(1000));
}

void add_quality(CLI::App& app, bool& quality, NodeCosts& costs)
{
    app.add_flag("--epo,--quality", quality, "compute end-point overlap, which takes long");
    app.add_option("--sah-inner", costs.inner, "what visiting an inner node costs")
        ->capture_default_str()
        ->check(a_number(most_cost));
    app.add_option("--sah-triangle", costs.triangle, "what testing a triangle costs")
        ->capture_default_str()
        ->check(a_number(most_cost));
    app.final_callback([&costs] {
        if (costs == NodeCosts{0, 0})
            throw BadUsage("--sah-inner and --sah-triangle must not both be 0");
    });
}

}  // namespace bvhbench
