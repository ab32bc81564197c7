// SPDX-License-Identifier: MIT
#include <filesystem>
#include <iostream>
#include <mutex>

#include "builders/orders.h"
#include "geometry/error.h"
#include "harness/build_info.h"
#include "harness/commands.h"
#include "harness/failure.h"
#include "harness/interrupt.h"
#include "harness/progress.h"
#include "harness/provenance.h"
#include "harness/result_file.h"
#include "harness/test_hooks.h"
#include "harness/trials.h"
#include "harness/tuning_file.h"

namespace bvhbench {
namespace {

std::vector<std::string> targets_of(const TuneCommand& command)
{
    if (!command.target.empty())
        return {command.target};
    return {"sort", "oibvh-multi", "leaf", "group", "bvtt"};
}

SearchOptions options_of(const TuneCommand& command, const Device& device)
{
    SearchOptions options;
    options.is_cpu = device.is_cpu();
    if (command.quick) {
        options.samples = 5;
        options.warm_up = 1;
        options.rounds = 1;
    }
    if (command.samples > 0)
        options.samples = command.samples;
    return options;
}

/// Where the device's file is: as --out says, else in the folder that values are read from, else where the sources
/// keep them.
std::filesystem::path path_of(const TuneCommand& command, const Options& options,
                              const Device& device)
{
    if (!command.out.empty())
        return command.out;
    const std::string folder = tuning_folder(options.common.tuning).value_or("");
    return std::filesystem::path(folder.empty() ? "results/tuning" : folder) /
           (device_slug(device.name()) + ".json");
}

/// What the search settled takes the place of what the file had of it.
void put(const SearchResult& result, const TuneTask& task, int samples, TuningFile& file)
{
    for (const Parameter* parameter : result.searched)
        file.values.erase(std::string(parameter->name));
    for (const Kept& kept : result.kept)
        file.values[std::string(kept.parameter->name)] = {
            .value = kept.value,
            .target = task.target,
            .scene = task.scene,
            .ratio = kept.ratio,
            .samples = samples,
            .found_at = utc_now(),
            .commit = build_info.commit + std::string(build_info.dirty ? "+" : "")};
}

/// Search, say what was found, and write it; as much as was found so far when a signal ends the program. Throws what loading
/// the scene and the search do, and BadUsage where there is no parameter.
void tune_target(Session& session, const TuneTask& task, const SearchOptions& options,
                 const Output& output, TuningFile& file,
                 const std::function<void(const std::string&)>& note)
{
    TuneTarget over(session, task);
    const Tuning in_effect = tuning_of(file, session.device(), output.path().string());
    const auto keep = [&](const SearchResult& found) {
        std::cout << "tuned: " << task.target << " over " << task.scene << " on "
                  << session.device().name() << '\n'
                  << search_report(found) << std::flush;
        put(found, task, options.samples, file);
        output.replace(tuning_text(file));
    };
    SearchResult result, so_far;
    std::mutex mutex;  // of what is so far
    {
        const AtSignal kept(
            [&] {
                const std::lock_guard lock(mutex);
                keep(so_far);
            },
            "what was found is kept");
        search([&](const Tuning& tuning) { return over.trial(tuning); }, in_effect,
               [&](const Parameter& parameter) { return over.wants(parameter); }, options,
               [&](const std::string& what) {
                   const std::lock_guard lock(mutex);
                   so_far = result;
                   note(", " + what);
               },
               result);
    }
    if (result.searched.empty())
        throw BadUsage(task.target + " asks " + session.device().name() +
                       " for no parameter: there is nothing to tune");
    keep(result);
}

}  // namespace

int tune(const TuneCommand& command, const Options& options)
{
    // Wrong words are found before anything is opened.
    if (!test_hooks().empty())
        throw BadUsage(test_hooks().begin()->first +
                       " is set, which changes times for tests: nothing is tuned by such");
    for (const std::string& target : targets_of(command))
        check_target(target);
    find_builder(command.builder.name);
    find_order(command.builder.order);
    check_boxes(command.builder);

    Session session(options.common);
    const Device& device = session.device();
    const std::filesystem::path path = path_of(command, options, device);
    NamedTuning named = tuning_file_for(device, tuning_folder(options.common.tuning));
    const Output output(path, "--out",
                        {.inputs = scene_files(command.scene, session.scenes()),
                         .may_replace = [](const std::string&) { return true; }});
    // Values that are there are kept; what is no tuning file is refused.
    TuningFile file = output.was_there() ? read_tuning(path) : std::move(named.file);
    tuning_of(file, device, path.string());  // refuses another device's now
    file.device = device.name();
    file.driver = device_facts(device).driver;

    const SearchOptions search_options = options_of(command, device);
    const std::vector<std::string> targets = targets_of(command);
    Progress progress(targets.size());
    std::string first_reason;
    std::size_t failed = 0;
    for (const std::string& target : targets) {
        const TuneTask task{target, command.scene, command.builder, command.collider};
        progress.step("tune: " + target);
        const auto tune = [&] {
            tune_target(session, task, search_options, output, file,
                        [&](const std::string& what) { progress.note("tune: " + target + what); });
        };
        if (targets.size() == 1) {
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
    if (failed == targets.size())
        throw NothingMeasured("nothing was tuned: " + first_reason);
    std::cout << "written: " << path.string() << '\n';
    return 0;
}

}  // namespace bvhbench
