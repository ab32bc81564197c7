// SPDX-License-Identifier: MIT
#include "harness/experiment_pipelines.h"

#include "collide/narrow_methods.h"
#include "collide/skips.h"
#include "geometry/error.h"
#include "harness/swept.h"

namespace bvhbench {
namespace {

unsigned number_at(const Json& json, const char* key, std::int64_t most)
{
    return json.contains(key) ? static_cast<unsigned>(whole_number(json[key], key, 0, most)) : 0;
}

/// The value at `key`, or each of the list there.
void read_each(const Json& json, const char* key, const std::function<void(const Json&)>& add)
{
    if (json[key].is_array())
        read_list(json, key, add);
    else
        add(json[key]);
}

PipelineChoice pipeline_of(const Json& json, const BuilderChoice& builder, const Json& collider)
{
    PipelineChoice choice;
    choice.builder = builder;
    choice.collider = collider_choice(collider);
    if (json.contains("pairs_of"))
        choice.collider.among = among_called(text_at(json, "pairs_of"));
    if (json.contains("adjacent")) {
        const std::string adjacent = text_at(json, "adjacent");
        if (adjacent != "keep" && adjacent != "drop")
            throw BadUsage("'adjacent' is keep or drop, not '" + adjacent + "'");
        choice.collider.keep_adjacent = adjacent == "keep";
    }
    if (json.contains("no_skip")) {
        const std::string rule = text_at(json, "no_skip");
        choice.collider.rules_off = skip_rules_called({&rule, 1});
    }
    if (json.contains("narrow"))
        choice.collider.narrow = text_at(json, "narrow");
    check_narrow(choice.collider.narrow, choice.collider.keep_adjacent);
    return choice;
}

/// Each of the builders with each of the colliders.
std::vector<PipelineChoice> pipelines_of(const Json& json)
{
    refuse_unknown_keys(json, {"builder", "collider", "pairs_of", "adjacent", "narrow", "no_skip"},
                        "a pipeline");
    if (!json.contains("collider"))
        throw BadUsage("a pipeline needs 'collider'");
    std::vector<BuilderChoice> builders;
    if (json.contains("builder"))
        read_each(json, "builder",
                  [&](const Json& item) { builders.push_back(builder_choice(item)); });
    else
        builders.push_back({.name = "none"});
    std::vector<PipelineChoice> choices;
    for (const BuilderChoice& builder : builders)
        read_each(json, "collider",
                  [&](const Json& item) { choices.push_back(pipeline_of(json, builder, item)); });
    return choices;
}

CollideTask task_of(const Json& json, const std::vector<PipelineChoice>& pipelines)
{
    CollideTask task;
    task.may_stand_in = true;
    task.pipelines = pipelines;
    if (json.is_string()) {
        task.scene = json.get<std::string>();
        return task;
    }
    refuse_unknown_keys(json, {"scene", "frames", "between", "objects", "pairs_of", "swept"},
                        "a scene");
    task.scene = text_at(json, "scene");
    if (json.contains("frames"))
        task.frames = frame_range(text_at(json, "frames"));
    task.between = number_at(json, "between", 1000);
    if (json.contains("objects"))
        task.objects = objects_by_called(text_at(json, "objects"));
    if (json.contains("pairs_of"))
        for (PipelineChoice& pipeline : task.pipelines)
            pipeline.collider.among = among_called(text_at(json, "pairs_of"));
    if (json.contains("swept")) {
        if (!json["swept"].is_boolean())
            throw BadUsage("'swept' is true or false");
        task.swept = json["swept"].get<bool>();
        if (task.swept)
            check_swept(task);
    }
    return task;
}

}  // namespace

ColliderChoice collider_choice(const Json& json)
{
    ColliderChoice choice;
    if (json.is_string()) {
        choice.name = json.get<std::string>();
    } else {
        refuse_unknown_keys(json, {"name", "jump", "start_level", "group_size"}, "a collider");
        choice.name = text_at(json, "name");
        choice.jump = number_at(json, "jump", 32);
        choice.start_level = number_at(json, "start_level", 32);
        choice.group_size = number_at(json, "group_size", 1 << 16);
    }
    find_collider(choice.name);
    return choice;
}

std::vector<CollideTask> collisions_of(const Json& json, const std::string& experiment, bool quick)
{
    const Json none = Json::object();
    const Json& quicker = quick && json.contains("quick") ? json["quick"] : none;
    if (!json.contains("builders"))
        refuse_unknown_keys(quicker, {"scenes", "pipelines", "samples", "warm_up"}, "'quick'");
    const auto of = [&](const char* key) -> const Json& {
        return quicker.contains(key) ? quicker : json;
    };
    std::vector<PipelineChoice> pipelines;
    read_list(of("pipelines"), "pipelines", [&](const Json& item) {
        for (PipelineChoice& choice : pipelines_of(item))
            pipelines.push_back(std::move(choice));
    });
    std::vector<CollideTask> tasks;
    read_list(of("scenes"), "scenes", [&](const Json& item) {
        CollideTask task = task_of(item, pipelines);
        task.experiment = experiment;
        if (of("samples").contains("samples"))
            task.samples =
                static_cast<int>(whole_number(of("samples")["samples"], "samples", 1, 1000000));
        if (of("warm_up").contains("warm_up"))
            task.warm_up =
                static_cast<int>(whole_number(of("warm_up")["warm_up"], "warm_up", 0, 1000000));
        tasks.push_back(std::move(task));
    });
    return tasks;
}

}  // namespace bvhbench
