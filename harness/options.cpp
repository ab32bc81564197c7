// SPDX-License-Identifier: MIT
#include "harness/options.h"

#include <CLI/CLI.hpp>
#include <sstream>

#include "geometry/error.h"
#include "harness/build_info.h"
#include "harness/command_line.h"

namespace bvhbench {
namespace {

constexpr int most_seconds = 1000000;

void add_common(CLI::App& app, CommonOptions& common)
{
    app.add_option("--device", common.device, "words of its name, or its index in `list devices`");
    app.add_option("--kernels", common.kernels, "a source tree to read kernels from");
    app.add_option("--data", common.data, "the folder of data sets; default: BVHBENCH_DATA");
    app.add_option(
           "--doubles", common.doubles,
           "recentred or as-is: how coordinates of a file that floats cannot hold are rounded")
        ->capture_default_str();
    app.add_option(
        "--tuning", common.tuning,
        "a folder to read tuned values from, '' for none; default: BVHBENCH_TUNING, else "
        "those in the program");
    app.add_option(
           "--memory-limit", common.memory_limit,
           "bytes that device and host may each take, as 512M or 2G; default: all there are")
        ->transform(CLI::AsSizeValue(false));
    app.add_option("--time-limit", common.time_limit_s,
                   "seconds that a single build or query may take before it is given up; 0: no end")
        ->capture_default_str()
        ->check(a_number(most_seconds));
    app.add_flag("--verbose", common.verbose, "say on stderr what is being used");
    app.set_version_flag("--version", std::string("bvhbench ") + build_info.version);
    app.require_subcommand(0, 1);
    app.fallthrough();  // common options may stand behind the command's own
}

void check_power_of_two(const char* option, unsigned value)
{
    if ((value & (value - 1)) != 0)
        throw BadUsage(std::string(option) + " must be a power of two, not " +
                       std::to_string(value));
}

void check_costs(const NodeCosts& costs)
{
    if (costs == NodeCosts{0, 0})
        throw BadUsage("--sah-inner and --sah-triangle must not both be 0");
}

}  // namespace

Options parse_options(int argc, const char* const* argv)
{
    CLI::App app("Compare builders of bounding volume hierarchies for collision detection.",
                 "bvhbench");
    Options options{{}, {}, {argv, argv + argc}};
    ListCommand list;
    BuildCommand build;
    CollideCommand collide;
    RunCommand run;
    ReproduceCommand reproduce;
    CheckCommand check;
    ShowCommand show;
    TuneCommand tune;
    AccuracyCommand accuracy;
    StressCommand stress;
    std::string leaves = "mesh";
    std::string adjacent = "keep";
    std::string pairs_of = "all";
    std::vector<std::string> no_skip;
    add_common(app, options.common);
    add_list(app, list);
    add_build(app, build, leaves);
    add_collide(app, collide, leaves, adjacent, pairs_of, no_skip);
    add_run(app, run);
    add_reproduce(app, reproduce);
    add_check(app, check);
    add_show(app, show);
    add_tune(app, tune, leaves, adjacent);
    add_accuracy(app, accuracy);
    add_stress(app, stress);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        std::ostringstream out;
        if (app.exit(error, out, out) != 0)
            throw BadUsage(std::string(error.what()) + "; `bvhbench --help` lists what there is");
        options.command = PrintCommand{out.str()};
        return options;
    }
    if (app.get_subcommands().empty())
        throw BadUsage(
            "name a command: list, build, collide, run, reproduce, check, show, tune, accuracy or "
            "stress; "
            "`bvhbench --help` says what they do");
    check_power_of_two("--group-size", build.builder.group_size);
    check_power_of_two("--items", build.builder.items);
    for (const NodeCosts& costs : {build.costs, run.costs, reproduce.costs})
        check_costs(costs);
    check_power_of_two("--group-size", collide.collider.group_size);
    build.builder.sorted_leaves = collide.builder.sorted_leaves = tune.builder.sorted_leaves =
        leaves == "sorted";
    collide.collider.keep_adjacent = tune.collider.keep_adjacent = adjacent == "keep";
    collide.collider.among = among_called(pairs_of);
    collide.collider.rules_off = skip_rules_called(no_skip);
    const std::string chosen = app.get_subcommands().front()->get_name();
    if (chosen == "list")
        options.command = list;
    else if (chosen == "build")
        options.command = build;
    else if (chosen == "collide")
        options.command = collide;
    else if (chosen == "run")
        options.command = run;
    else if (chosen == "reproduce")
        options.command = reproduce;
    else if (chosen == "check")
        options.command = check;
    else if (chosen == "tune")
        options.command = tune;
    else if (chosen == "accuracy")
        options.command = accuracy;
    else if (chosen == "stress")
        options.command = stress;
    else
        options.command = show;
    return options;
}

}  // namespace bvhbench
