// SPDX-License-Identifier: MIT
#include "harness/options.h"

#include <CLI/CLI.hpp>
#include <cctype>
#include <charconv>
#include <cstdint>
#include <map>
#include <sstream>

#include "geometry/error.h"
#include "harness/build_info.h"
#include "harness/command_line.h"
#include "harness/help.h"

namespace bvhbench {
namespace {

constexpr int most_seconds = 1000000;

/// "2G" and the like: a whole number of bytes, or of as many as the letter says, with or without a B.
std::size_t bytes_of(const std::string& text)
{
    constexpr std::string_view letters = "KMGT";
    const char* const end = text.data() + text.size();
    std::uint64_t number = 0;
    const auto read = std::from_chars(text.data(), end, number);
    std::string unit(read.ptr, end);
    for (char& letter : unit)
        letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
    if (!unit.empty() && unit.back() == 'B')
        unit.pop_back();
    const std::size_t place = unit.empty() ? 0 : letters.find(unit) + 1;
    const bool is_unit = unit.size() <= 1 && place <= letters.size() && (unit.empty() || place > 0);
    const unsigned shift = static_cast<unsigned>(10 * place);
    if (read.ec != std::errc() || !is_unit || number == 0 || number > (UINT64_MAX >> shift))
        throw CLI::ValidationError(
            "--memory-limit",
            "must be a number of bytes from 1 on, as 512M or 2G, not '" + text + "'");
    return number << shift;
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
    app.add_option(
        "--tuning", common.tuning,
        "a folder to read tuned values from, '' for none; default: BVHBENCH_TUNING, else "
        "those in the program");
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

/// "list, build or show"
std::string names_of(const std::vector<CLI::App*>& commands)
{
    std::string text;
    for (std::size_t k = 0; k < commands.size(); ++k)
        text += (k == 0 ? "" : k + 1 < commands.size() ? ", " : " or ") + commands[k]->get_name();
    return text;
}

/// An empty name of an output would write nothing without a word.
void check_outputs_are_named(const CLI::App& command)
{
    for (const char* output : {"--out", "--json", "--dump", "--pairs", "--contacts"})
        if (const CLI::Option* option = command.get_option_no_throw(output);
            option != nullptr && option->count() > 0 && option->results().back().empty())
            throw BadUsage(std::string(output) + " names no file or folder");
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
    SweepCommand sweep;
    MergeCommand merge;
    PlotCommand plot;
    ReportCommand report;
    CompareCommand compare;
    SmokeCommand smoke;
    std::string leaves;
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
    add_sweep(app, sweep);
    add_merge(app, merge);
    add_plot(app, plot);
    add_report(app, report, leaves);
    add_compare(app, compare);
    add_smoke(app, smoke);
    add_help(app);
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
        throw BadUsage("name a command: " + names_of(app.get_subcommands({})) +
                       "; `bvhbench --help` says what they do");
    check_outputs_are_named(*app.get_subcommands().front());
    check_power_of_two("--group-size", build.builder.group_size);
    check_power_of_two("--items", build.builder.items);
    for (const NodeCosts& costs : {build.costs, run.costs, reproduce.costs, sweep.costs})
        check_costs(costs);
    check_power_of_two("--group-size", collide.collider.group_size);
    for (BuilderChoice* builder :
         {&build.builder, &collide.builder, &tune.builder, &report.builder})
        builder->sorted_leaves = leaves == "sorted" || (leaves.empty() && builder->boxes != "f32");
    collide.collider.keep_adjacent = tune.collider.keep_adjacent = adjacent == "keep";
    collide.collider.among = among_called(pairs_of);
    collide.collider.rules_off = skip_rules_called(no_skip);
    if (collide.swept) {
        if (app.get_subcommands().front()->count("--adjacent") > 0 && adjacent == "keep")
            throw BadUsage(
                "--swept leaves out pairs that share a vertex, which touch all the way: there are "
                "none "
                "for --adjacent keep");
        collide.collider.keep_adjacent = false;
    }
    const std::map<std::string_view, Command> commands = {
        {"list", list},         {"build", build},         {"collide", collide}, {"run", run},
        {"check", check},       {"reproduce", reproduce}, {"show", show},       {"tune", tune},
        {"accuracy", accuracy}, {"stress", stress},       {"sweep", sweep},     {"merge", merge},
        {"plot", plot},         {"report", report},       {"compare", compare}, {"smoke", smoke},
    };
    options.command = commands.at(app.get_subcommands().front()->get_name());
    return options;
}

}  // namespace bvhbench
