// SPDX-License-Identifier: MIT
#include "harness/options.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <sstream>

#include "geometry/error.h"
#include "harness/build_info.h"

namespace bvhbench {
namespace {

constexpr int most_samples = 1000000;
constexpr int most_cost = 1000000;
constexpr int most_seconds = 1000000;

/// Accepts only `known` words; the answer to another one lists them.
CLI::Validator one_of(std::vector<std::string> known)
{
    const auto check = [known = std::move(known)](const std::string& word) {
        std::string there;
        for (const std::string& each : known) {
            if (each == word)
                return std::string();
            there += (there.empty() ? "" : ", ") + each;
        }
        return "there is no '" + word + "'; there are: " + there;
    };
    return {check, "", "one of"};
}

/// A number from 0 to `most`: CLI::Range lets NaN pass.
CLI::Validator a_number(int most)
{
    const auto check = [most](const std::string& word) {
        double value = -1;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        const bool is_read = error == std::errc() && end == word.data() + word.size();
        return is_read && value >= 0 && value <= most
                   ? std::string()
                   : "must be a number from 0 to " + std::to_string(most) + ", not '" + word +
                         "'";
    };
    return {check, "", "a number"};
}

void add_quality(CLI::App& command, bool& quality, NodeCosts& costs)
{
    command.add_flag("--epo,--quality", quality, "compute end-point overlap, which takes long");
    command.add_option("--sah-inner", costs.inner, "what visiting an inner node costs")
        ->capture_default_str()
        ->check(a_number(most_cost));
    command.add_option("--sah-triangle", costs.triangle, "what testing a triangle costs")
        ->capture_default_str()
        ->check(a_number(most_cost));
}

void add_list(CLI::App& app, ListCommand& list)
{
    CLI::App* command = app.add_subcommand("list", "What there is, a line each");
    command
        ->add_option(
            "WHAT", list.what,
            "builders, colliders, narrow, orders, skips, tuning, scenes, devices, accuracy or "
            "experiments")
        ->required()
        ->check(one_of({"builders", "colliders", "narrow", "orders", "skips", "tuning", "scenes",
                        "devices", "accuracy", "experiments"}));
}

void add_build(CLI::App& app, BuildCommand& build, std::string& leaves)
{
    CLI::App* command = app.add_subcommand("build", "Build one tree, check it and time its stages");
    command->add_option("--builder", build.builder.name, "a name of `list builders`")->required();
    command->add_option("--scene", build.scene, "a scene, data set or mesh file")->required();
    command->add_option("--order", build.builder.order, "a name of `list orders`")
        ->capture_default_str();
    command->add_option("--group-size", build.builder.group_size,
                        "work-items in a group, a power of two; 0: the builder's choice");
    command->add_option("--items", build.builder.items,
                        "nodes a work-item merges in registers, a power of two; 0: likewise");
    command->add_option("--leaves", leaves, "mesh or sorted: where leaf boxes are kept")
        ->check(one_of({"mesh", "sorted"}));
    command->add_option("--samples", build.samples, "timed builds")
        ->capture_default_str()
        ->check(CLI::Range(1, most_samples));
    add_quality(*command, build.quality, build.costs);
    command->add_option("--json", build.json, "write the result file");
    command->add_option("--dump", build.dump, "write the tree, spelled out, as JSON");
}

void add_collide(CLI::App& app, CollideCommand& collide, std::string& leaves, std::string& adjacent,
                 std::string& pairs_of, std::vector<std::string>& no_skip)
{
    CLI::App* command = app.add_subcommand(
        "collide",
        "Find the pairs of triangles that overlap or intersect, frame by frame, check them and time "
        "the stages");
    collide.builder.name = "oibvh-multi";
    command->add_option("--builder", collide.builder.name, "a name of `list builders`")
        ->capture_default_str();
    command->add_option("--collider", collide.collider.name, "a name of `list colliders`")
        ->required();
    command->add_option("--scene", collide.scenes, "scenes, data sets, mesh files or folders")
        ->required();
    command
        ->add_option("--objects", collide.objects,
                     "what gets a tree of its own: auto, one, mesh or components")
        ->capture_default_str();
    command->add_option("--pairs-of", pairs_of, "pairs of all triangles, between objects or within")
        ->capture_default_str()
        ->check(one_of({"all", "between", "within"}));
    command->add_option("--frames", collide.frames, "a:b, from frame a to before b")
        ->capture_default_str();
    command
        ->add_option("--between", collide.between,
                     "frames put between each two of the scene's, in a straight line")
        ->check(CLI::Range(0, 1000));
    command
        ->add_option(
            "--narrow", collide.collider.narrow,
            "which pairs intersect: exact, a name of `list narrow`, or none, to stop at their "
            "boxes")
        ->capture_default_str();
    command->add_option("--order", collide.builder.order, "a name of `list orders`")
        ->capture_default_str();
    command->add_option("--leaves", leaves, "mesh or sorted: where leaf boxes are kept")
        ->check(one_of({"mesh", "sorted"}));
    command->add_option("--adjacent", adjacent, "keep or drop pairs that share a vertex index")
        ->capture_default_str()
        ->check(one_of({"keep", "drop"}));
    command->add_option("--jump", collide.collider.jump,
                        "levels a step of a traversal descends; 0: the collider's choice");
    command->add_option("--start-level", collide.collider.start_level,
                        "the level a traversal starts on; 0: likewise");
    command->add_option("--group-size", collide.collider.group_size,
                        "work-items in a group, a power of two; 0: the collider's choice");
    command->add_option("--no-skip", no_skip,
                        "a rule of `list skips` that is not used, or all: work is done that need not be");
    command->add_flag("--skips", collide.skips,
                      "measure each rule switched off as well, and what it saves");
    command->add_option("--samples", collide.samples, "timed builds and queries")
        ->capture_default_str()
        ->check(CLI::Range(1, most_samples));
    command->add_option("--json", collide.json, "write the result file");
    command->add_option("--pairs", collide.pairs,
                        "write the last frame's pairs: .csv, or .bin of 32-bit ids");
    command->add_option("--contacts", collide.contacts, "the same of the pairs that intersect");
}

void add_run(CLI::App& app, RunCommand& run)
{
    CLI::App* command = app.add_subcommand("run", "Run an experiment and write its result file");
    command
        ->add_option("EXPERIMENT", run.experiment, "a name of `list experiments`, or a .json file")
        ->required();
    command->add_option("--out", run.out, "the result file; default: <experiment>.json");
    command->add_option("--filter", run.filter, "only cells whose scene/builder this matches");
    command->add_option("--samples", run.samples, "timed builds a cell")
        ->check(CLI::Range(1, most_samples));
    command->add_flag("--quick", run.quick, "fewer scenes and samples");
    add_quality(*command, run.quality, run.costs);
}

void add_reproduce(CLI::App& app, ReproduceCommand& reproduce)
{
    CLI::App* command =
        app.add_subcommand("reproduce", "Measure, print and draw what the paper shows");
    command->add_option("WHAT", reproduce.what, "table1 to table4, fig8, fig9, fig10 or fig13")
        ->required()
        ->check(one_of({"table1", "table2", "table3", "table4", "fig8", "fig9", "fig10", "fig13"}));
    command->add_option("--out", reproduce.out, "folder for the result file and figures")
        ->capture_default_str();
    command->add_flag("--quick", reproduce.quick, "fewer scenes and samples");
    add_quality(*command, reproduce.quality, reproduce.costs);
}

void add_check(CLI::App& app, CheckCommand& check)
{
    CLI::App* command =
        app.add_subcommand("check", "Hold builders to every promise, without timing");
    command->add_option("--builder", check.builder, "only this one");
    command->add_option("--scene", check.scene, "over this instead of the hard inputs");
}

void add_show(CLI::App& app, ShowCommand& show)
{
    CLI::App* command = app.add_subcommand("show", "Print a result file as tables");
    command->add_option("FILE", show.file, "a result file")->required();
}

void add_accuracy(CLI::App& app, AccuracyCommand& accuracy)
{
    CLI::App* command = app.add_subcommand(
        "accuracy", "Measure run time against error, along an axis at a time, print and draw it");
    command->add_option("--axis", accuracy.axis, "a name of `list accuracy`; default: all in turn");
    command->add_option("--scene", accuracy.scenes,
                        "scenes, data sets or mesh files, of axes that are about scenes");
    command
        ->add_option("--pairs", accuracy.pairs,
                     "pairs of triangles in all, of the axis narrow, at least one a class")
        ->capture_default_str()
        ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 32));
    command->add_option("--seed", accuracy.seed, "of what is generated")
        ->capture_default_str()
        ->check(CLI::Range(1u, 1000000000u));
    command->add_option("--filter", accuracy.filter, "only cells whose input/method this matches");
    command->add_option("--samples", accuracy.samples, "timed runs a cell")
        ->capture_default_str()
        ->check(CLI::Range(1, most_samples));
    command->add_option("--out", accuracy.out, "folder for the result file and figures")
        ->capture_default_str();
}

void add_tune(CLI::App& app, TuneCommand& tune, std::string& leaves, std::string& adjacent)
{
    CLI::App* command = app.add_subcommand(
        "tune", "Search what numbers suit the device, check each answer, and write a tuning file");
    command->add_option("TARGET", tune.target,
                        "sort, a name of `list builders` or of `list colliders`; default: sort, "
                        "oibvh-multi, leaf, group and bvtt in turn");
    command->add_option("--scene", tune.scene, "a scene, data set or mesh file")->required();
    tune.builder.name = "oibvh-multi";
    command->add_option("--builder", tune.builder.name, "whose trees a collider is tuned over")
        ->capture_default_str();
    command->add_option("--order", tune.builder.order, "a name of `list orders`")
        ->capture_default_str();
    command->add_option("--leaves", leaves, "mesh or sorted: where leaf boxes are kept")
        ->check(one_of({"mesh", "sorted"}));
    command->add_option("--adjacent", adjacent, "keep or drop pairs that share a vertex index")
        ->capture_default_str()
        ->check(one_of({"keep", "drop"}));
    command->add_option("--narrow", tune.collider.narrow, "none or exact: whether to tune it too")
        ->capture_default_str()
        ->check(one_of({"none", "exact"}));
    command->add_option("--samples", tune.samples, "timed runs a value and turn")
        ->check(CLI::Range(3, most_samples));
    command->add_flag("--quick", tune.quick, "one round, and fewer samples");
    command->add_option("--out", tune.out,
                        "the tuning file; default: the device's in --tuning, else in results/tuning");
}

void add_stress(CLI::App& app, StressCommand& stress)
{
    CLI::App* command = app.add_subcommand("stress",
                                           "Hold builders, colliders and libraries to what must "
                                           "hold over scenes that are hard on them");
    command->add_flag("--quick", stress.quick, "smaller scenes and fewer systems");
    command->add_option("--seed", stress.seed, "of what is random")->capture_default_str();
    command->add_option("--filter", stress.filter,
                        "only cells whose family/scene/system this matches");
    command->add_option("--out", stress.out, "write the result file");
}

void add_common(CLI::App& app, CommonOptions& common)
{
    app.add_option("--device", common.device, "words of its name, or its index in `list devices`");
    app.add_option("--kernels", common.kernels, "a source tree to read kernels from");
    app.add_option("--data", common.data, "the folder of data sets; default: BVHBENCH_DATA");
    app.add_option("--tuning", common.tuning,
                   "a folder to read tuned values from, '' for none; default: BVHBENCH_TUNING, else "
                   "those in the program");
    app.add_option("--memory-limit", common.memory_limit,
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
            "name a command: list, build, collide, run, reproduce, check, show, tune, accuracy or stress; "
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
