// SPDX-License-Identifier: MIT
#include <filesystem>
#include <iostream>
#include <optional>

#include "builders/orders.h"
#include "geometry/error.h"
#include "harness/build_info.h"
#include "harness/commands.h"
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
    Progress progress(targets_of(command).size());
    for (const std::string& target : targets_of(command)) {
        const TuneTask task{target, command.scene, command.builder, command.collider};
        progress.step("tune: " + target);
        TuneTarget over(session, task);
        const Tuning in_effect = tuning_of(file, device, path.string());
        SearchResult result;
        std::optional<Interrupted> interrupted;
        try {
            search([&](const Tuning& tuning) { return over.trial(tuning); }, in_effect,
                   [&](const Parameter& parameter) { return over.wants(parameter); },
                   search_options,
                   [&](const std::string& what) { progress.note("tune: " + target + ", " + what); },
                   result);
        } catch (const Interrupted& stop) {
            interrupted = stop;
        }
        if (!interrupted && result.searched.empty())
            throw BadUsage(target + " asks " + device.name() +
                           " for no parameter: there is nothing to tune");
        std::cout << "tuned: " << target << " over " << command.scene << " on " << device.name()
                  << '\n'
                  << search_report(result);
        put(result, task, search_options.samples, file);
        output.replace(tuning_text(file));
        if (interrupted)
            throw *interrupted;
    }
    std::cout << "written: " << path.string() << '\n';
    return 0;
}

}  // namespace bvhbench
