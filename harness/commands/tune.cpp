// SPDX-License-Identifier: MIT
#include <filesystem>
#include <iostream>
#include <mutex>

#include "geometry/error.h"
#include "harness/base/build_info.h"
#include "harness/base/failure.h"
#include "harness/base/terminal.h"
#include "harness/base/test_hooks.h"
#include "harness/choice/choices.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"
#include "harness/record/provenance.h"
#include "harness/record/result_file.h"
#include "harness/session/tuning_file.h"
#include "harness/tune/trials.h"
#include "process/interrupt.h"

namespace bvhbench {
namespace {

/// Replaces the file's values of all searched parameters by the values that the search found.
void put(const SearchResult& result, const TuneTask& task, int samples, TuningFile& file)
{
    for (const Parameter* parameter : result.searched)
        file.values.erase(std::string(parameter->name));
    for (const TrialResult& kept : result.kept)
        file.values[std::string(kept.parameter->name)] = {
            .value = kept.value,
            .target = task.target,
            .scene = task.scene,
            .ratio = kept.ratio,
            .samples = samples,
            .found_at = utc_now(),
            .commit = build_info.commit + std::string(build_info.dirty ? "+" : "")};
}

/// Searches one target, prints the result and writes the file. A signal writes what was found so far. Throws BadUsage if the
/// target has no parameters, and what loading the scene and searching throw.
void tune_target(Session& session, const TuneTask& task, const SearchOptions& options,
                 const Output& output, TuningFile& file, Progress& progress)
{
    TuneTarget over(session, task);
    const Tuning in_effect = tuning_of(file, session.device(), output.path().string());
    SearchResult result;
    std::mutex mutex;  // guards result
    const auto keep = [&] {
        const std::lock_guard lock(mutex);
        progress.clear();
        std::cout << "tuned: " << task.target << " over " << task.scene << " on "
                  << session.device().name() << '\n'
                  << search_report(result) << std::flush;
        put(result, task, options.samples, file);
        output.replace(tuning_text(file));
    };
    {
        const AtSignal kept(keep, "what was found is kept");
        const auto tell = [&](const std::string& what, const SearchResult& found) {
            const std::lock_guard lock(mutex);
            result = found;
            progress.note("tune: " + task.target + ", " + what);
        };
        SearchResult found = search(
            [&](const Tuning& tuning) { return over.trial(tuning); }, in_effect,
            [&](const Parameter& parameter) { return over.wants(parameter); }, options, tell);
        const std::lock_guard lock(mutex);
        result = std::move(found);
    }
    if (result.searched.empty())
        throw BadUsage(task.target + " asks " + session.device().name() +
                       " for no parameter: there is nothing to tune");
    keep();
}

class Tune final : public Command {
public:
    void add_options(CLI::App& app) override
    {
        choice_.builder.name = "oibvh-multi";
        app.add_option("TARGET", targets_,
                       "sort, a name of `list builders` or of `list colliders`; default: sort, "
                       "oibvh-multi, leaf, group and bvtt in turn")
            ->expected(1);
        app.add_option("--scene", scene_, "a scene, data set or mesh file")->required();
        app.add_option("--builder", choice_.builder.name, "whose trees a collider is tuned over")
            ->capture_default_str();
        add_choices(app, choice_, [](const Choice& option) {
            return option.key == "order" || option.key == "boxes" || option.key == "leaves" ||
                   option.key == "adjacent" || option.key == "narrow";
        });
        app.add_option("--samples", samples_, "timed runs a value and turn")
            ->check(CLI::Range(3, most_samples));
        app.add_flag("--quick", quick_, "one round, and fewer samples");
        app.add_option(
            "--out", out_,
            "the tuning file; default: the device's in --tuning, else in results/tuning");
    }

    int run(const Invocation& invocation) override
    {
        check_words();
        const CommonOptions& common = invocation.common;
        Session session(common);
        session.check_clocks();
        const Device& device = session.device();
        const std::filesystem::path path = path_of(common, device);
        NamedTuning named = tuning_file_for(device, tuning_folder(common.tuning));
        const Output output(path, "--out",
                            {.inputs = scene_files(scene_, session.scenes()),
                             .may_replace = [](const std::string&) { return true; }});
        // Existing values are kept. An existing file that is no tuning file is an error.
        TuningFile file = output.was_there() ? read_tuning(path) : std::move(named.file);
        if (!output.was_there() && file.device != device.name())
            file = {};  // of the nearest device
        else if (!file.values.empty() && file.device != device.name())
            throw Unavailable(path.string() + ": its values are of '" + file.device +
                              "', and the device is '" + device.name() + "'");
        file.device = device.name();
        file.kind = kind_of(device);
        file.driver = text_at(device_facts(device), "driver");
        tune_all(session, output, file);
        std::cout << "written: " << path.string() << '\n';
        return 0;
    }

private:
    /// Throws BadUsage for wrong options, before the device is opened.
    void check_words() const
    {
        if (!test_hooks().empty())
            throw BadUsage(test_hooks().begin()->first +
                           " is set, which changes times for tests: nothing is tuned by such");
        for (const std::string& target : targets_)
            check_target(target);
        check_choice(choice_);
        check_powers(choice_);
        if (choice_.collider.narrow != "none" && choice_.collider.narrow != "exact")
            throw BadUsage("'narrow' takes none or exact here, not '" + choice_.collider.narrow +
                           "'");
    }

    SearchOptions search_options(const Device& device) const
    {
        SearchOptions options;
        if (quick_)
            options = {.samples = 5, .warm_up = 1, .rounds = 1};
        options.is_cpu = device.is_cpu();
        if (samples_ > 0)
            options.samples = samples_;
        return options;
    }

    /// Returns the path of the device's file: --out, else in the folder that tuned values are read from, else in results/tuning.
    std::filesystem::path path_of(const CommonOptions& common, const Device& device) const
    {
        if (!out_.empty())
            return out_;
        const std::string folder = tuning_folder(common.tuning).value_or("");
        return std::filesystem::path(folder.empty() ? "results/tuning" : folder) /
               (device_slug(device.name()) + ".json");
    }

    /// Tunes all targets and prints the reason for each one that fails. Throws NothingMeasured if all fail. With a single
    /// target, its own error is thrown.
    void tune_all(Session& session, const Output& output, TuningFile& file) const
    {
        Progress progress(targets_.size());
        std::string first_reason;
        std::size_t failed = 0;
        for (const std::string& target : targets_) {
            const TuneTask task{target, scene_, choice_.builder, choice_.collider};
            progress.step("tune: " + target);
            const auto tune = [&] {
                tune_target(session, task, search_options(session.device()), output, file,
                            progress);
            };
            if (targets_.size() == 1) {
                tune();
                continue;
            }
            const std::string failure = reason_of_failure(tune);
            if (failure.empty())
                continue;
            session.renew_queue();
            std::cout << "not tuned: " << target << ": " << failure << '\n';
            if (failed++ == 0)
                first_reason = failure;
        }
        if (failed == targets_.size())
            throw NothingMeasured("nothing was tuned: " + first_reason);
    }

    std::vector<std::string> targets_ = {"sort", "oibvh-multi", "leaf", "group", "bvtt"};
    std::string scene_;
    CellChoice choice_;  ///< options of the builder, or of the collider and its trees
    std::string out_;
    int samples_ = 0;  ///< 0: the default number
    bool quick_ = false;
};

}  // namespace

extern const CommandEntry tune_command = {
    "tune",
    measuring,
    "Search what numbers suit the device, check each answer, and write a tuning file",
    "No value changes what is built or found, and each answer is checked. Later runs read the file "
    "from --tuning.",
    {{"bvhbench tune sort --scene torus:144046", "the sort alone"},
     {"bvhbench tune --scene bunny --device nvidia --out tuning/mine.json", "all in turn"}},
    "docs/tuning.md",
    make_command<Tune>};

}  // namespace bvhbench
