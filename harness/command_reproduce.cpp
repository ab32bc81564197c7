// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <map>
#include <span>

#include "geometry/error.h"
#include "harness/commands.h"
#include "harness/plot.h"
#include "harness/report.h"
#include "harness/report_frames.h"
#include "harness/report_paper.h"
#include "harness/report_quality.h"
#include "harness/run.h"

namespace bvhbench {
namespace {

/// A table or figure of the paper that shows what was measured.
struct Shown {
    std::string_view name;
    std::string_view experiment;  ///< Figs. 9 and 10 show other sides of what Table 2 measures
    std::string (*report)(const Document&);
};

constexpr std::array shown_in_paper = {
    Shown{"table1", "table1", table1_report},
    Shown{"fig8", "fig8", fig8_report},
    Shown{"table2", "table2", [](const Document& of) { return frames_table(of, "table2"); }},
    Shown{"fig9", "table2", [](const Document& of) { return frames_table(of, "table2"); }},
    Shown{"fig10", "table2", [](const Document& of) { return frames_table(of, "table2"); }},
    Shown{"table3", "table3", [](const Document& of) { return frames_table(of, "table3"); }},
    Shown{"table4", "table4", table4_report},
    Shown{"fig13", "fig13", fig13_report},
};

/// The scene that the page of everything shows in three dimensions: small, and with contacts.
constexpr const char* page_scene = "cloth-funnel:2000:4";
constexpr unsigned page_frame = 3;

/// What runs have in common, and how they ended.
class Reproduction {
public:
    /// Into a file for each name, all of which are reserved before anything is measured.
    Reproduction(const ReproduceCommand& command, const Options& options,
                 std::span<const std::string> names)
        : command_(command), options_(options), session_(options.common)
    {
        const OutputRules rules =
            result_rules(options.common.force, {}, session_.watchdog().run_id());
        make_folder(command.out);
        check_pictures(command.out, "--out", rules);
        for (const std::string& name : names)
            outputs_.try_emplace(name, std::filesystem::path(command.out) / (name + ".json"),
                                 "--out", rules);
    }

    /// Measure `experiment` into a file of that `name`, print the table of the first and draw all that are shown of it.
    void run(std::string_view experiment, const std::string& name, std::span<const Shown> shown)
    {
        const std::filesystem::path folder = command_.out;
        Output output = std::move(outputs_.at(name));
        const std::filesystem::path file = output.path();
        Experiment task = find_experiment(std::string(experiment), command_.quick);
        task.quality = task.quality || command_.quality;
        Run run(session_, std::move(output), options_.words, command_.costs);
        run.experiment(task);
        run.finish();
        std::cout << run_report(run.document().run) << shown.front().report(run.document())
                  << run.written();
        files_.push_back(file.string());
        try {
            differs_ = exit_code_of(run.document()) == 1 || differs_;
            is_measured_ = true;
        } catch (const NothingMeasured& error) {
            if (why_not_.empty())
                why_not_ = error.what();
            return;
        }
        for (const Shown& each : shown)
            std::cout << draw(std::string(each.name) + ".py", file, folder, options_.common.force)
                      << '\n';
    }

    const std::vector<std::string>& files() const { return files_; }

    /// Of all that was run. Throws NothingMeasured.
    int exit_code() const
    {
        if (!is_measured_)
            throw NothingMeasured(why_not_);
        return differs_ ? 1 : 0;
    }

private:
    const ReproduceCommand& command_;
    const Options& options_;
    Session session_;
    std::map<std::string, Output> outputs_;
    std::vector<std::string> files_;
    bool differs_ = false, is_measured_ = false;
    std::string why_not_;
};

int reproduce_all(const ReproduceCommand& command, const Options& options)
{
    ReportCommand page;
    page.out = (std::filesystem::path(command.out) / "report.html").string();
    page.scenes = {page_scene};
    page.frame = page_frame;
    int code = 0;
    {
        std::vector<std::string> names;
        for (const Shown& each : shown_in_paper)
            names.emplace_back(each.experiment);
        Reproduction reproduction(command, options, names);
        Output(page.out, "--out", {.force = options.common.force, .may_replace = is_page});
        for (std::size_t begin = 0, end = 0; begin < shown_in_paper.size(); begin = end) {
            const std::string_view experiment = shown_in_paper[begin].experiment;
            while (end < shown_in_paper.size() && shown_in_paper[end].experiment == experiment)
                ++end;
            reproduction.run(experiment, std::string(experiment),
                             std::span(shown_in_paper).subspan(begin, end - begin));
        }
        page.files = reproduction.files();
        code = reproduction.exit_code();
    }  // the device's memory is free for the page's scene
    // As where figures cannot be drawn: what was measured is there, and can be shown elsewhere.
    try {
        const int status = report(page, options);
        return status != 0 ? status : code;
    } catch (const Unavailable& error) {
        std::cout << "no page was made: " << error.what() << "; elsewhere: bvhbench report "
                  << command.out << "/*.json -o " << page.out << '\n';
        return code;
    }
}

}  // namespace

std::vector<std::string> reproducible()
{
    std::vector<std::string> names;
    for (const Shown& each : shown_in_paper)
        names.emplace_back(each.name);
    names.emplace_back("all");
    return names;
}

int reproduce(const ReproduceCommand& command, const Options& options)
{
    if (command.what == "all")
        return reproduce_all(command, options);
    const Shown& shown =
        *std::find_if(shown_in_paper.begin(), shown_in_paper.end(),
                      [&](const Shown& each) { return each.name == command.what; });
    Reproduction reproduction(command, options, std::span(&command.what, 1));
    reproduction.run(shown.experiment, command.what, std::span(&shown, 1));
    return reproduction.exit_code();
}

}  // namespace bvhbench
