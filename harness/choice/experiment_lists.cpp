// SPDX-License-Identifier: MIT
#include "harness/choice/experiment_lists.h"

#include <set>

#include "geometry/error.h"
#include "harness/choice/choices.h"
#include "scenes/catalog.h"

namespace bvhbench {
namespace {

/// Stands for all methods from outside; there may be none.
constexpr auto all_outside = "outside";
constexpr std::int64_t most_triangles = std::int64_t{1} << 31, most_sizes = 1 << 24;

/// Returns the numbers of a list, or those that an object describes: at least 1, sorted, without repetitions.
std::set<std::int64_t> sizes_of(const Json& json, const std::string& key)
{
    std::set<std::int64_t> sizes;
    if (json.is_array()) {
        for (const Json& size : json)
            sizes.insert(number_of<std::int64_t>(size, key, 1, most_triangles));
        return sizes;
    }
    refuse_unknown_keys(
        json, {"from", "to", "powers_of_two_from", "powers_of_two_to", "around_powers_of_two_to"},
        "the sizes '" + key + "'");
    std::int64_t from = 1, to = 0, first_power = 1, last_power = 0, around = 0;
    read_number(json, "from", 1, most_sizes, from);
    read_number(json, "to", 1, most_sizes, to);
    read_number(json, "powers_of_two_from", 1, most_triangles, first_power);
    read_number(json, "powers_of_two_to", 1, most_triangles, last_power);
    read_number(json, "around_powers_of_two_to", 1, most_triangles / 2, around);
    for (std::int64_t size = from; size <= to; ++size)
        sizes.insert(size);
    for (std::int64_t power = 1; power <= std::max(last_power, around); power *= 2) {
        if (power >= first_power && power <= last_power)
            sizes.insert(power);
        if (power <= around)
            sizes.insert({power - 1, power, power + 1});
    }
    sizes.erase(0);
    return sizes;
}

/// Calls `add` with the value at `key`, or with each item if it is a list. In place of `all_outside` it calls it with each name of the
/// catalog from outside.
void read_each(const Json& json, const char* key, auto catalog,
               const std::function<void(const Json&)>& add)
{
    const auto add_all = [&](const Json& item) {
        if (item != all_outside)
            return add(item);
        for (const auto& entry : catalog)
            if (entry.outside != nullptr)
                add(entry.name);
    };
    if (json[key].is_array())
        read_list(json, key, add_all);
    else
        add_all(json[key]);
}

/// Reads a name, or an object of `name` and the options of `of`. `what` is "a builder" or "a collider".
void read_named(const Json& json, Choice::Of of, const std::string& what, CellChoice& choice,
                std::string& name)
{
    if (json.is_string()) {
        name = json.get<std::string>();
        return;
    }
    refuse_unknown_keys(json, choice_keys(of, {"name"}), what);
    read_choices(json, of, choice);
    name = text_at(json, "name");
}

PipelineChoice pipeline_of(const Json& json, const BuilderChoice& builder, const Json& collider)
{
    CellChoice choice{.builder = builder};
    read_named(collider, Choice::Of::collider, "a collider", choice, choice.collider.name);
    read_choices(json, Choice::Of::query, choice);
    check_choice(choice);
    return {choice.builder, choice.collider};
}

/// Returns each combination of the builders and colliders.
std::vector<PipelineChoice> pipelines_of(const Json& json)
{
    refuse_unknown_keys(json, choice_keys(Choice::Of::query, {"builder", "collider"}),
                        "a pipeline");
    if (!json.contains("collider"))
        throw BadUsage("a pipeline needs 'collider'");
    std::vector<BuilderChoice> builders = {{.name = "none"}};
    if (json.contains("builder"))
        builders = builder_choices(json, "builder");
    std::vector<PipelineChoice> choices;
    for (const BuilderChoice& builder : builders)
        read_each(json, "collider", collider_catalog(),
                  [&](const Json& item) { choices.push_back(pipeline_of(json, builder, item)); });
    return choices;
}

/// Reads a scene. Its `pairs_of` overrides that of all its pipelines.
CollideTask task_of(const Json& json, const std::vector<PipelineChoice>& pipelines)
{
    CollideTask task;
    task.may_stand_in = true;
    task.pipelines = pipelines;
    if (json.is_string()) {
        task.scene = scene_name(json.get<std::string>());
    } else {
        refuse_unknown_keys(json, choice_keys(Choice::Of::scene, {"scene", "pairs_of"}), "a scene");
        task.scene = scene_name(text_at(json, "scene"));
        CellChoice choice;
        read_choices(json, Choice::Of::scene, choice);
        static_cast<SceneChoice&>(task) = choice.scene;
        if (json.contains("pairs_of")) {
            read_choices({{"pairs_of", json["pairs_of"]}}, Choice::Of::query, choice);
            for (PipelineChoice& pipeline : task.pipelines)
                pipeline.collider.among = choice.collider.among;
        }
    }
    check_features(task);
    return task;
}

}  // namespace

std::vector<std::string> scene_names(const Json& json)
{
    if (json.is_string())
        return {json.get<std::string>()};
    if (json == Json{{"scene", text_in(json, "scene")}, {"objects", "one"}})
        return {text_at(json, "scene")};  // as one object, as builders take every scene
    if (!json.is_object() || json.size() != 2 || !json.contains("scene"))
        throw BadUsage("a scene is text, or an object of 'scene' and the sizes that it names");
    const std::string key =
        json.begin().key() == "scene" ? std::next(json.begin()).key() : json.begin().key();
    const std::string pattern = text_at(json, "scene"), hole = '{' + key + '}';
    const std::size_t at = pattern.find(hole);
    if (at == pattern.npos)
        throw BadUsage("the scene '" + pattern + "' has no " + hole + " for its sizes");
    std::vector<std::string> names;
    for (const std::int64_t size : sizes_of(json[key], key))
        names.push_back(std::string(pattern).replace(at, hole.size(), std::to_string(size)));
    return names;
}

std::vector<BuilderChoice> builder_choices(const Json& json, const char* key)
{
    std::vector<BuilderChoice> choices;
    read_each(json, key, builder_catalog(), [&](const Json& item) {
        CellChoice choice;
        read_named(item, Choice::Of::builder, "a builder", choice, choice.builder.name);
        find_builder(choice.builder.name);
        check_choice(choice);
        choices.push_back(choice.builder);
    });
    return choices;
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
    if (is_true(json, "skips"))
        pipelines = with_each_rule_off(pipelines);
    std::vector<CollideTask> tasks;
    read_list(of("scenes"), "scenes", [&](const Json& item) {
        CollideTask task = task_of(item, pipelines);
        task.experiment = experiment;
        read_number(of("samples"), "samples", 1, most_samples, task.samples);
        read_number(of("warm_up"), "warm_up", 0, most_samples, task.warm_up);
        tasks.push_back(std::move(task));
    });
    return tasks;
}

}  // namespace bvhbench
