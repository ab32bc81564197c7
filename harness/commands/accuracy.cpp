// SPDX-License-Identifier: MIT
#include <filesystem>
#include <iostream>

#include "geometry/error.h"
#include "harness/accuracy/axis.h"
#include "harness/base/python.h"
#include "harness/choice/choices.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"
#include "harness/record/result_file.h"

namespace bvhbench {
namespace {

class Accuracy final : public Command {
public:
    void add_options(CLI::App& app) override
    {
        app.add_flag_callback(  // before the options that it sets, which override it
            "--quick",
            [this] { task_.pairs = 20'000, task_.samples = 1, task_.scenes = {quick_scene}; },
            "fewer pairs and samples, and of axes about scenes a small one");
        app.add_option("--axis", axis_, "a name of `list accuracy`; default: all in turn");
        app.add_option("--scene", task_.scenes,
                       "scenes, data sets or mesh files, of axes about scenes; of the axis queries "
                       "files of them");
        app.add_option("--pairs", task_.pairs,
                       "pairs of triangles in all, of the axis narrow, at least one a class")
            ->capture_default_str()
            ->check(CLI::Range(std::size_t{1}, std::size_t{1} << 32));
        app.add_option("--seed", task_.seed, "of what is generated")
            ->capture_default_str()
            ->check(CLI::Range(1u, 1000000000u));
        app.add_option("--filter", filter_, "only cells whose input/method this matches");
        app.add_option("--samples", task_.samples, "timed runs a cell")
            ->capture_default_str()
            ->check(CLI::Range(1, most_samples));
        add_choices(app, choice_, [](const Choice& one) { return one.key == "separation"; });
        app.add_option("--out", out_, "folder for the result file and figures")
            ->capture_default_str();
    }

    int run(const Invocation& invocation) override
    {
        const std::span<const Axis> axes =
            axis_.empty() ? accuracy_axes() : std::span(&find_axis(axis_), 1);
        task_.filter = cell_filter(filter_);
        task_.separation = choice_.collider.separation;
        if (task_.separation != "none" && axis_ != "impacts" && axis_ != "queries")
            throw BadUsage("--separation is about motions: it needs --axis impacts or queries");
        const std::filesystem::path folder = out_;
        const std::filesystem::path file =
            folder / (axis_.empty() ? "accuracy.json" : "accuracy-" + axis_ + ".json");
        const CommonOptions& common = invocation.common;
        Session session(common);
        std::filesystem::create_directories(folder);
        const OutputRules rules =
            result_rules(common.force, files_of(task_.scenes, session.scenes()));
        check_pictures(folder, "--out", rules);
        ResultFile results(Output(file, "--out", rules), common.force,
                           measured_facts(session, invocation.words));
        Progress progress(axes.size());
        int order = 0;
        for (const Axis& axis : axes) {
            progress.step("accuracy, " + std::string(axis.name));
            axis.measure(
                {session, task_, order, progress, [&](Cell&& cell) { results.add(cell); }});
        }
        if (results.size() == 0)
            throw BadUsage("--filter: no cell matches '" + filter_ + "'");
        results.finish(session.end_of_run());
        progress.clear();
        print_tables(results.text(), common);
        std::cout << results.written();
        const int code = results.exit_code();
        std::cout << draw(file, folder, common.force);
        return code;
    }

private:
    std::string axis_;  ///< empty: all axes
    AxisTask task_;
    CellChoice choice_;
    std::string filter_;
    std::string out_ = "out";
};

}  // namespace

extern const CommandEntry accuracy_command = {
    "accuracy",
    measuring,
    "Measure run time against error, along an axis at a time, print and draw it",
    "Errors are counted against exact arithmetic on the stored coordinates: how many were missed, "
    "how many were false.",
    {{"bvhbench accuracy --axis narrow --quick",
      "narrow phases: how often is each wrong, and how fast?"},
     {"bvhbench accuracy --axis boxes --scene bunny --out out/boxes", "boxes in fewer bits"}},
    "docs/accuracy.md",
    make_command<Accuracy>};

}  // namespace bvhbench
