// SPDX-License-Identifier: MIT
#include "harness/commands/words.h"

#include <re2/re2.h>

#include <algorithm>
#include <cstdint>

#include "builders/orders.h"
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

/// Accepts a number from 0 to `most`, or a share, as "5%" or "0.05", which a transformation replaces by its decimal. CLI::Range would
/// accept NaN.
CLI::Validator a_number(double most, bool is_share = false)
{
    const std::string what = is_share ? "share" : "number",
                      unit = is_share ? "%, as 5% or 0.05" : "";
    const int end = static_cast<int>(is_share ? 100 * most : most);
    const auto read = [=](std::string& word) {
        double value = -1;
        std::string percent;
        const bool is_read = RE2::FullMatch(word, "([-+.\\deE]+)(%?)", &value, &percent);
        value /= percent.empty() ? 1 : 100;
        if (!is_read || (!is_share && !percent.empty()) || value < 0 || value > most)
            return "must be a " + what + " from 0 to " + std::to_string(end) + unit + ", not '" +
                   word + "'";
        word = is_share ? Json(value).dump() : word;
        return std::string();
    };
    return {read, "", "a " + what};
}

}  // namespace

void add_common(CLI::App& app, CommonOptions& common)
{
    app.add_option("--device", common.device,
                   "gpu, cpu, words of its name, or its index in `list devices`; default: "
                   "BVHBENCH_DEVICE, else the first GPU, else the processor");
    app.add_option("--kernels", common.kernels, "a source tree to read kernels from");
    app.add_option("--data", common.data, "the folder of data sets; default: BVHBENCH_DATA");
    app.add_option("--doubles", common.doubles,
                   "recentred or as-is: how coordinates of a file that floats cannot hold are "
                   "rounded; kept: steps between frames go by the doubles")
        ->capture_default_str();
    app.add_flag("--weld", common.weld,
                 "join vertices of equal position, so that triangles beside each other are "
                 "neighbours: STL has no other way to say so");
    app.add_option("--clock", common.clock,
                   "device or host: whose clock times stages on the device; with the host's, each "
                   "stage waits for the one before")
        ->check(CLI::IsMember({"device", "host"}))
        ->capture_default_str();
    app.add_option("--tuning", common.tuning,
                   "a folder to read tuned values from, '' for none; default: BVHBENCH_TUNING, "
                   "else those in the program");
    app.add_option("--plugin", common.plugins,
                   "a shared library with builders and colliders (docs/plugins.md); may be said "
                   "again; besides those in BVHBENCH_PLUGINS")
        ->allow_extra_args(false);
    app.add_option("--program", common.programs,
                   "a program with builders and colliders (docs/plugins.md); may be said again")
        ->allow_extra_args(false);
    app.add_option_function<std::string>(
        "--memory-limit",
        [&common](const std::string& text) { common.memory_limit = bytes_of(text); },
        "bytes that the program may take in all, and the device, as 512M or 2G; default: all there "
        "are");
    app.add_option(
           "--time-limit", common.time_limit_s,
           "seconds that a single build, query or oracle may take before it is given up; 0: no end")
        ->capture_default_str()
        ->check(a_number(most_seconds));
    app.add_flag("--force", common.force, "replace files that are there, but none that is read");
    app.add_flag("--quiet", common.quiet, "print no tables of results");
    app.add_flag("--wide", common.wide,
                 "print tables with all columns; without it, they fit the terminal. In a file or "
                 "pipe they have all");
    app.add_flag("--verbose", common.verbose, "say on stderr what is being used");
}

void add_sampling(CLI::App& app, int& samples, const char* help, SamplingWords& sampling)
{
    CLI::Option* number =
        app.add_option("--samples", samples, help)->check(CLI::Range(1, most_samples));
    if (samples > 0)
        number->capture_default_str();
    app.add_option("--until", sampling.until,
                   "sample each cell until the range between its quartiles is this share of the "
                   "median, as 2%")
        ->transform(a_number(1, true))
        ->excludes(number);
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
    app.add_option("--caches", sampling.caches,
                   "hot, cold or host: where a sample finds its data, in caches, in the device's "
                   "memory, or in the host's, with both copies timed; several, as hot,cold, are "
                   "cells of their own; hot")
        ->delimiter(',');
    app.add_option("--energy", sampling.energy_s,
                   "seconds that each cell runs alone after its samples, to count the joules of a "
                   "run; 0: none")
        ->check(a_number(60));
    app.add_option("--calibrate-every", sampling.calibrate_every,
                   "samples between two looks at how fast the device is; 0: none; 16")
        ->check(CLI::Range(0, most_samples));
    app.add_option("--drift-limit", sampling.drift_limit,
                   "mark samples beside a look that is further off its median; 25%")
        ->transform(a_number(1000, true));
}

CLI::Option* add_names(CLI::App& app, const char* option, std::vector<std::string>& names,
                       const char* help, int most)
{
    return app.add_option(option, names, help)->delimiter(',')->expected(1, most);
}

void SeveralNames::add_to(CLI::App& app, int most)
{
    add_names(app, "--builder", builders, "names of `list builders`; left out: the fastest", most);
    add_names(app, "--order", orders,
              "names of `list orders`; left out: the fastest, after --builder morton30", most);
    add_names(app, "--collider", colliders, "names of `list colliders`; left out: the fastest",
              most);
}

std::string SeveralNames::take_best(const BestPipeline& best, BuilderChoice& builder)
{
    std::string chosen;
    if (colliders.empty())
        chosen = '`' + colliders.emplace_back(best.collider) + '`';
    const bool is_open = builders.empty();
    if (is_open)
        builders.emplace_back(best.builder);
    if (orders.empty())
        orders.emplace_back(is_open ? best.order : paper_order);
    builder.sorted_leaves |= is_open;
    if (is_open && std::ranges::any_of(colliders, [](const std::string& name) {
            return find_collider(name).needs_tree;
        }))
        chosen += (chosen.empty() ? "" : " over ") + builders[0] + ", order " + orders[0];
    return chosen.empty() ? ""
                          : chosen +
                                ": the fastest of ours on this device; --builder, --order and "
                                "--collider name others\n";
}

std::vector<CellChoice> SeveralNames::combined_with(const CellChoice& choice) const
{
    std::vector<CellChoice> all;
    for (const std::string& collider : colliders.empty() ? std::vector<std::string>{""} : colliders)
        for (const std::string& builder : builders)
            for (const std::string& order : orders) {
                CellChoice one = choice;
                one.collider.name = collider;
                const bool needs_tree = collider.empty() || find_collider(collider).needs_tree;
                one.builder.name = needs_tree ? builder : builders.front();
                if (needs_tree && !find_builder(builder).own_order)
                    one.builder.order = order;
                find_order(order);
                check_choice(one);
                check_powers(one);
                if (std::ranges::count(all, one) == 0)
                    all.push_back(one);
            }
    return all;
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
