// SPDX-License-Identifier: MIT
#include "harness/choice/experiment.h"

#include <re2/re2.h>

#include "geometry/names.h"
#include "harness/choice/experiment_lists.h"
#include "scenes/catalog.h"

namespace bvhbench {
namespace {

/// Reads the keys that `quick` may replace.
void read_size(const Json& json, Experiment& experiment)
{
    if (json.contains("scenes")) {
        experiment.scenes.clear();
        read_list(json, "scenes", [&](const Json& item) {
            for (const std::string& scene : scene_names(item))
                experiment.scenes.push_back(scene_name(scene));
        });
    }
    if (json.contains("builders"))
        experiment.builders = builder_choices(json);
    read_number(json, "samples", 1, most_samples, experiment.samples);
    read_number(json, "warm_up", 0, most_samples, experiment.warm_up);
}

SamplingRules sampling_of(const Json& json)
{
    SamplingRules rules;
    read_number(json, "until", 0, 1, rules.until);
    for (const char* key : {"min_samples", "max_samples", "time_budget_s"})
        if (json.contains(key) && rules.until == 0)
            throw BadUsage("'" + std::string(key) +
                           "' bounds what 'until' begins, which is not there");
    read_number(json, "min_samples", 2, most_samples, rules.min_samples);
    read_number(json, "max_samples", 2, most_samples, rules.max_samples);
    read_number(json, "time_budget_s", 0, 1e6, rules.time_budget_s);
    if (json.contains("caches")) {
        const Json& caches = json["caches"];
        rules.caches.clear();
        for (const Json& one : caches.is_array() ? caches : Json::array({caches}))
            rules.caches.push_back(
                caches_called(one.is_string() ? one.get<std::string>() : one.dump()));
        if (rules.caches.empty())
            throw BadUsage("'caches' is an empty list");
    }
    read_number(json, "energy_s", 0, 60, rules.energy_s);
    if (json.contains("race"))
        rules.race = race_called(text_at(json, "race"));
    check_rules(rules);
    return rules;
}

Start start_of(const Json& json)
{
    constexpr std::string_view known[] = {"bounds", "codes",  "sort",
                                          "order",  "gather", "hierarchy"};
    read_list(json, "stages", [&](const Json& stage) {
        const std::string name = stage.is_string() ? stage.get<std::string>() : "";
        if (std::ranges::count(known, name) == 0)
            throw BadUsage(stage.dump() + " is no stage" + there_are(name, known));
    });
    return json["stages"] == Json{"hierarchy"} ? Start::from_sorted_leaves : Start::from_triangles;
}

std::vector<Operation> operations_of(const Json& json)
{
    std::vector<Operation> wanted;
    if (json.is_array())
        for (const Operation operation : {Operation::build, Operation::refit})
            if (std::count(json.begin(), json.end(), operation_name(operation)) == 1)
                wanted.push_back(operation);
    if (wanted.empty() || wanted.size() != json.size())
        throw BadUsage("'operations' must be a list of build, refit or both, not " + json.dump());
    return wanted;
}

}  // namespace

Experiment experiment_of(const Json& json, bool quick)
{
    refuse_unknown_keys(
        json, {"experiment",  "question",      "paper",   "scenes",   "builders", "operations",
               "pipelines",   "stages",        "samples", "warm_up",  "until",    "min_samples",
               "max_samples", "time_budget_s", "race",    "caches",   "quality",  "doubles",
               "skips",       "quick",         "label",   "clusters", "energy_s"},
        "an experiment");
    const bool collides = json.contains("pipelines"), has_ranks = json.contains("clusters");
    if (has_ranks)
        refuse_unknown_keys(json, {"experiment", "question", "paper", "label", "clusters"},
                            "an experiment with 'clusters'");
    const std::vector<const char*> required = {"experiment", "scenes",
                                               collides ? "pipelines" : "builders"};
    for (const char* key : std::span(required).first(has_ranks ? 1 : required.size()))
        if (!json.contains(key))
            throw BadUsage("an experiment must have the key '" + std::string(key) + "'");
    Experiment experiment;
    experiment.name = text_at(json, "experiment");
    if (!RE2::FullMatch(experiment.name, "[A-Za-z0-9_-]+"))  // it is part of file names
        throw BadUsage("'experiment' must be letters, digits, - and _, not '" + experiment.name +
                       "'");
    experiment.label = text_in(json, "label");
    experiment.source = json.dump();
    experiment.question = text_in(json, "question");
    experiment.paper = text_in(json, "paper");
    if (json.contains("doubles"))
        experiment.doubles = doubles_called(text_at(json, "doubles"));
    experiment.sampling = sampling_of(json);
    experiment.sampling.energy_s *= quick ? 0 : 1;
    experiment.quality = is_true(json, "quality");
    if (collides)
        experiment.collisions = collisions_of(json, experiment.name, quick);
    for (CollideTask& task : experiment.collisions)
        task.sampling = experiment.sampling;
    if (has_ranks)
        read_list(json, "clusters", [&](const Json& entry) {
            experiment.clusters.push_back(cluster_task_of(entry, experiment.name));
        });
    if (has_ranks || (collides && !json.contains("builders")))
        return experiment;
    read_size(json, experiment);
    if (json.contains("stages"))
        experiment.start = start_of(json);
    if (json.contains("operations"))
        experiment.operations = operations_of(json["operations"]);
    if (!json.contains("quick"))
        return experiment;
    std::vector<std::string_view> keys = {"scenes", "builders", "samples", "warm_up"};
    if (collides)
        keys.insert(keys.begin() + 2, "pipelines");
    refuse_unknown_keys(json["quick"], keys, "'quick'");
    Experiment quicker = experiment;
    read_size(json["quick"], quicker);
    return quick ? quicker : experiment;
}

std::span<const std::string_view> experiment_names()
{
    static constexpr std::string_view names[] = {BVHBENCH_EXPERIMENTS};  // "agreement", ...
    return names;
}

Experiment parse_experiment(std::string_view text, const std::string& origin, bool quick)
{
    return read_json(text, origin, [&](const Json& json) { return experiment_of(json, quick); });
}

std::string experiment_text(const std::string& name_or_path)
{
    if (const auto text = embedded_experiment("harness/experiments/" + name_or_path + ".json"))
        return std::string(*text);
    if (!name_or_path.ends_with(".json"))
        throw BadUsage("no experiment is called '" + name_or_path + '\'' +
                       there_are(name_or_path, experiment_names(), "or the path of a .json file"));
    return file_text(name_or_path, "the experiment file");
}

Experiment find_experiment(const std::string& name_or_path, bool quick)
{
    return parse_experiment(experiment_text(name_or_path), name_or_path, quick);
}

}  // namespace bvhbench
