// SPDX-License-Identifier: MIT
#include "harness/command_line.h"

#include <charconv>

#include "geometry/error.h"
#include "harness/commands.h"

namespace bvhbench {
namespace {

constexpr int most_cost = 1000000;
constexpr int most_seconds = 1000000;

/// Behind --samples, which it is instead of.
void add_sampling(CLI::App& command, SamplingWords& sampling)
{
    command
        .add_option("--until", sampling.until,
                    "sample each cell until the range between its quartiles is this share of the "
                    "median, as 2%")
        ->transform(a_share(1))
        ->excludes("--samples");
    command.add_option("--min-samples", sampling.min_samples, "with --until: at least so many; 15")
        ->check(CLI::Range(2, most_samples));
    command
        .add_option("--max-samples", sampling.max_samples, "with --until: at most so many; 1000")
        ->check(CLI::Range(2, most_samples));
    command
        .add_option("--time-budget", sampling.time_budget_s,
                    "with --until: seconds for the samples of a scene or frame; 60")
        ->check(a_number(most_seconds));
    command.add_flag("--cold", sampling.cold, "empty the device's caches before each sample");
    command
        .add_option("--calibrate-every", sampling.calibrate_every,
                    "samples between two looks at how fast the device is; 0: none; 16")
        ->check(CLI::Range(0, most_samples));
    command
        .add_option("--drift-limit", sampling.drift_limit,
                    "mark samples beside a look that is further off its median; 25%")
        ->transform(a_share(1000));
}

}  // namespace

void add_leaves(CLI::App& command, std::string& leaves, std::string& boxes)
{
    command
        .add_option(
            "--leaves", leaves,
            "mesh or sorted: where leaf boxes are kept; default: mesh, and sorted for boxes "
            "other than f32")
        ->check(one_of({"mesh", "sorted"}));
    command
        .add_option("--boxes", boxes, "what nodes keep their boxes in: a name of `list formats`")
        ->capture_default_str();
}

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

CLI::Validator a_number(int most)
{
    const auto check = [most](const std::string& word) {
        double value = -1;
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        const bool is_read = error == std::errc() && end == word.data() + word.size();
        return is_read && value >= 0 && value <= most
                   ? std::string()
                   : "must be a number from 0 to " + std::to_string(most) + ", not '" + word + "'";
    };
    return {check, "", "a number"};
}

CLI::Validator a_share(double most)
{
    const auto read = [most](std::string& word) {
        const bool is_percent = word.ends_with('%');
        const std::size_t digits = word.size() - (is_percent ? 1 : 0);
        double value = -1;
        const auto [end, error] = std::from_chars(word.data(), word.data() + digits, value);
        if (is_percent)
            value /= 100;
        if (error != std::errc() || end != word.data() + digits || !(value >= 0 && value <= most))
            return "must be a share from 0 to " + std::to_string(static_cast<int>(100 * most)) +
                   "%, as 5% or 0.05, not '" + word + "'";
        char text[40];
        word.assign(text, std::to_chars(text, text + sizeof text, value).ptr);
        return std::string();
    };
    return {read, "", "a share"};
}

void add_list(CLI::App& app, ListCommand& list)
{
    CLI::App* command = app.add_subcommand("list", "What there is, a line each");
    command
        ->add_option("WHAT", list.what,
                     "builders, colliders, narrow, orders, formats, skips, tuning, scenes, "
                     "devices, accuracy or "
                     "experiments")
        ->required()
        ->check(one_of({"builders", "colliders", "narrow", "orders", "formats", "skips", "tuning",
                        "scenes", "devices", "accuracy", "experiments"}));
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
    command->add_option(
        "--items", build.builder.items,
        "nodes a work-item merges in registers, a power of two; 0: the builder's choice");
    add_leaves(*command, leaves, build.builder.boxes);
    command->add_option("--samples", build.samples, "timed builds")
        ->capture_default_str()
        ->check(CLI::Range(1, most_samples));
    add_sampling(*command, build.sampling);
    add_quality(*command, build.quality, build.costs);
    command->add_option("--json", build.json, "write the result file");
    command->add_option("--dump", build.dump, "write the tree, spelled out, as JSON");
}

void add_collide(CLI::App& app, CollideCommand& collide, std::string& leaves, std::string& adjacent,
                 std::string& pairs_of, std::vector<std::string>& no_skip)
{
    CLI::App* command = app.add_subcommand("collide",
                                           "Find the pairs of triangles that overlap or intersect, "
                                           "frame by frame, check them and time "
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
    command->add_flag(
        "--swept", collide.swept,
        "boxes around the way from each frame to the next: vertices against faces, and "
        "edges against edges; --pairs-of between or within has one of the two");
    command
        ->add_option(
            "--narrow", collide.collider.narrow,
            "which pairs intersect: exact, a name of `list narrow`, or none, to stop at their "
            "boxes")
        ->capture_default_str();
    command->add_option("--order", collide.builder.order, "a name of `list orders`")
        ->capture_default_str();
    command
        ->add_option("--grid", collide.builder.grid,
                     "object or scene: what codes are measured against, of several objects")
        ->transform(CLI::CheckedTransformer(std::map<std::string, GridOver>{
            {"object", GridOver::object}, {"scene", GridOver::scene}}));
    add_leaves(*command, leaves, collide.builder.boxes);
    command->add_option("--adjacent", adjacent, "keep or drop pairs that share a vertex index")
        ->capture_default_str()
        ->check(one_of({"keep", "drop"}));
    command->add_option("--jump", collide.collider.jump,
                        "levels a step of a traversal descends; 0: the collider's choice");
    command->add_option("--start-level", collide.collider.start_level,
                        "the level a traversal starts on; 0: the collider's choice");
    command->add_option("--group-size", collide.collider.group_size,
                        "work-items in a group, a power of two; 0: the collider's choice");
    command->add_option(
        "--no-skip", no_skip,
        "a rule of `list skips` that is not used, or all: work is done that need not be");
    command->add_flag("--skips", collide.skips,
                      "measure each rule switched off as well, and what it saves");
    command->add_option("--samples", collide.samples, "timed builds and queries")
        ->capture_default_str()
        ->check(CLI::Range(1, most_samples));
    add_sampling(*command, collide.sampling);
    command->add_option("--json", collide.json, "write the result file");
    command->add_option("--pairs", collide.pairs,
                        "write the pairs of every frame: .csv, or of one frame .bin of 32-bit ids");
    command->add_option("--contacts", collide.contacts, "the same of the pairs that intersect");
}

void add_run(CLI::App& app, RunCommand& run)
{
    CLI::App* command = app.add_subcommand("run", "Run an experiment and write its result file");
    command
        ->add_option("EXPERIMENT", run.experiment, "a name of `list experiments`, or a .json file")
        ->required();
    command->add_option("--out", run.out,
                        "the result file; default: <experiment>.json, of a file's experiment "
                        "<experiment>-results.json");
    command->add_option("--filter", run.filter, "only cells whose scene/builder this matches");
    command->add_option("--samples", run.samples, "timed builds a cell")
        ->check(CLI::Range(1, most_samples));
    add_sampling(*command, run.sampling);
    command->add_option("--turns", run.turns,
                        "FILE:N: sample by turns with other runs, N in all, that name the file");
    command->add_flag("--quick", run.quick, "fewer scenes and samples");
    add_quality(*command, run.quality, run.costs);
}

void add_reproduce(CLI::App& app, ReproduceCommand& reproduce)
{
    CLI::App* command =
        app.add_subcommand("reproduce", "Measure, print and draw what the paper shows");
    command
        ->add_option("WHAT", reproduce.what,
                     "table1 to table4, fig8, fig9, fig10, fig13; or all, and a page of all")
        ->required()
        ->check(one_of(reproducible()));
    command->add_option("--out", reproduce.out, "folder for result files, figures and the page")
        ->capture_default_str();
    command->add_flag("--quick", reproduce.quick, "fewer scenes and samples");
    add_quality(*command, reproduce.quality, reproduce.costs);
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
    add_leaves(*command, leaves, tune.builder.boxes);
    command->add_option("--adjacent", adjacent, "keep or drop pairs that share a vertex index")
        ->capture_default_str()
        ->check(one_of({"keep", "drop"}));
    command->add_option("--narrow", tune.collider.narrow, "none or exact: whether to tune it too")
        ->capture_default_str()
        ->check(one_of({"none", "exact"}));
    command->add_option("--samples", tune.samples, "timed runs a value and turn")
        ->check(CLI::Range(3, most_samples));
    command->add_flag("--quick", tune.quick, "one round, and fewer samples");
    command->add_option(
        "--out", tune.out,
        "the tuning file; default: the device's in --tuning, else in results/tuning");
}

}  // namespace bvhbench
