// SPDX-License-Identifier: MIT
#include "harness/choice/experiment.h"

#include <algorithm>
#include <cctype>

#include "geometry/error.h"
#include "harness/base/json_keys.h"
#include "harness/choice/experiment_lists.h"

namespace bvhbench {
namespace {

// To add an experiment, add its file to harness/experiments/ and its name here.
constexpr std::string_view names[] = {
    "table1",       "table4",    "fig8",    "fig13",     "peers",     "quality",
    "orders",       "scaling",   "refit",   "equality",  "smoke",     "table2",
    "table3",       "pairs",     "rebuild", "libraries", "agreement", "native",
    "native-pairs", "yardstick", "wide",    "roofline",  "swept"};

/// Reads the keys that `quick` may replace.
void read_size(const Json& json, Experiment& experiment)
{
    if (json.contains("scenes")) {
        experiment.scenes.clear();
        read_list(json, "scenes", [&](const Json& item) {
            for (std::string& scene : scene_names(item))
                experiment.scenes.push_back(std::move(scene));
        });
    }
    if (json.contains("builders")) {
        experiment.builders.clear();
        read_list(json, "builders",
                  [&](const Json& item) { experiment.builders.push_back(builder_choice(item)); });
    }
    read_whole(json, "samples", 1, most_samples, experiment.samples);
    read_whole(json, "warm_up", 0, most_samples, experiment.warm_up);
}

void read_real(const Json& json, const char* key, double most, double& value)
{
    if (!json.contains(key))
        return;
    if (!json[key].is_number() || !(json[key] >= 0.0 && json[key] <= most))
        throw BadUsage("'" + std::string(key) + "' must be a number from 0.0 to " +
                       Json(most).dump() + ", not " + json[key].dump());
    value = json[key].get<double>();
}

SamplingRules sampling_of(const Json& json)
{
    SamplingRules rules;
    read_real(json, "until", 1, rules.until);
    for (const char* key : {"min_samples", "max_samples", "time_budget_s"})
        if (json.contains(key) && rules.until == 0)
            throw BadUsage("'" + std::string(key) +
                           "' bounds what 'until' begins, which is not there");
    read_whole(json, "min_samples", 2, most_samples, rules.min_samples);
    read_whole(json, "max_samples", 2, most_samples, rules.max_samples);
    read_real(json, "time_budget_s", 1e6, rules.time_budget_s);
    if (json.contains("caches")) {
        const std::string caches = text_at(json, "caches");
        if (caches != "hot" && caches != "cold")
            throw BadUsage("'caches' is hot or cold, not '" + caches + "'");
        rules.cold = caches == "cold";
    }
    if (json.contains("race"))
        rules.race = race_called(text_at(json, "race"));
    check_rules(rules);
    return rules;
}

Start start_of(const Json& stages)
{
    constexpr std::string_view known[] = {"bounds", "codes",  "sort",
                                          "order",  "gather", "hierarchy"};
    if (!stages.is_array() || stages.empty())
        throw BadUsage("'stages' must be a list of at least one");
    for (const Json& stage : stages)
        if (!stage.is_string() || std::find(std::begin(known), std::end(known),
                                            stage.get<std::string>()) == std::end(known))
            throw BadUsage(stage.dump() + " is no stage; there are: " + joined(known));
    const bool only_hierarchy = stages.size() == 1 && stages[0] == "hierarchy";
    return only_hierarchy ? Start::from_sorted_leaves : Start::from_triangles;
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

Experiment experiment_of(const Json& json, bool quick)
{
    refuse_unknown_keys(
        json,
        {"experiment", "question", "paper", "scenes", "builders", "operations", "pipelines",
         "stages", "samples", "warm_up", "until", "min_samples", "max_samples", "time_budget_s",
         "race", "caches", "quality", "doubles", "quick"},
        "an experiment");
    const bool collides = json.contains("pipelines");
    for (const char* key : {"experiment", "scenes", collides ? "pipelines" : "builders"})
        if (!json.contains(key))
            throw BadUsage("an experiment must have the key '" + std::string(key) + "'");
    Experiment experiment;
    experiment.name = text_at(json, "experiment");
    check_experiment_name(experiment.name, "experiment");
    experiment.question = text_in(json, "question");
    experiment.paper = text_in(json, "paper");
    if (json.contains("doubles"))
        experiment.doubles = doubles_called(text_at(json, "doubles"));
    experiment.sampling = sampling_of(json);
    if (collides)
        experiment.collisions = collisions_of(json, experiment.name, quick);
    for (CollideTask& task : experiment.collisions)
        task.sampling = experiment.sampling;
    if (collides && !json.contains("builders"))
        return experiment;
    read_size(json, experiment);
    if (json.contains("stages"))
        experiment.start = start_of(json["stages"]);
    if (json.contains("operations"))
        experiment.operations = operations_of(json["operations"]);
    if (json.contains("quality"))
        experiment.quality = truth_at(json, "quality");
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

}  // namespace

std::span<const std::string_view> experiment_names() { return names; }

void check_experiment_name(const std::string& name, const std::string& key)
{
    const auto is_plain = [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '-' || c == '_';
    };
    if (name.empty() || !std::all_of(name.begin(), name.end(), is_plain))
        throw BadUsage('\'' + key + "' must be letters, digits, - and _, not '" + name + "'");
}

Experiment parse_experiment(std::string_view text, const std::string& origin, bool quick)
{
    try {
        return experiment_of(Json::parse(text), quick);
    } catch (const Json::exception& error) {
        throw BadUsage(origin + ": " + json_reason(error));
    } catch (const BadUsage& error) {
        throw BadUsage(origin + ": " + error.what());
    }
}

Experiment find_experiment(const std::string& name_or_path, bool quick)
{
    if (const auto text = embedded_experiment("harness/experiments/" + name_or_path + ".json"))
        return parse_experiment(*text, name_or_path, quick);
    if (!name_or_path.ends_with(".json"))
        throw BadUsage("no experiment is called '" + name_or_path +
                       "'; there are: " + joined(names) + ", or the path of a .json file");
    return parse_experiment(file_text(name_or_path, "the experiment file"), name_or_path, quick);
}

}  // namespace bvhbench
