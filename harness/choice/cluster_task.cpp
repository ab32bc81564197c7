// SPDX-License-Identifier: MIT
#include "harness/choice/cluster_task.h"

#include <algorithm>
#include <bit>

#include "builders/orders.h"
#include "collide/narrow/narrow_methods.h"
#include "geometry/error.h"
#include "geometry/names.h"
#include "harness/choice/choices.h"
#include "scenes/catalog.h"

namespace bvhbench {
namespace {

/// Returns the value of `Kind` with this name among `names`.
template <class Kind, std::size_t count>
Kind value_called(const std::string& what, const std::string& name,
                  const std::string_view (&names)[count])
{
    const auto found = std::ranges::find(names, name);
    if (found == std::end(names))
        throw BadUsage("no " + what + " is called '" + name + '\'' + there_are(name, names));
    return static_cast<Kind>(found - std::begin(names));
}

/// Returns the words of `cluster` that an entry stands for.
std::vector<std::string> words_of(const Json& json)
{
    std::vector<std::string> words = {"cluster", text_at(json, "scene")};
    for (const auto& [key, value] : json.items()) {
        if (key == "scene" || key == "samples" || value == false)
            continue;
        std::string option = "--" + key;
        std::ranges::replace(option, '_', '-');
        words.push_back(option);
        if (!value.is_boolean())
            words.push_back(value.is_string() ? value.get<std::string>() : value.dump());
    }
    return words;
}

}  // namespace

PartitionBy partition_called(const std::string& name)
{
    return value_called<PartitionBy>("partition", name, partition_names);
}

ClusterCheck cluster_check_called(const std::string& name)
{
    return value_called<ClusterCheck>("check", name, cluster_check_names);
}

void check_task(const ClusterTask& task)
{
    check_choice({task.pipeline.builder, task.pipeline.collider});
    check_narrow_of(task.pipeline.collider.narrow, NarrowOf::moment);
    find_order(task.pipeline.builder.order);
    triangles_in_name(task.scene);  // throws for a name that no scene can have
    if (!std::has_single_bit(task.boxes))
        throw BadUsage("the number of boxes is a power of two, not " + std::to_string(task.boxes));
}

ClusterTask cluster_task_of(const Json& json, const std::string& experiment)
{
    refuse_unknown_keys(
        json,
        {"scene", "ranks", "simulate", "partition", "builder", "order", "collider", "adjacent",
         "narrow", "boxes", "frames", "rebalance", "check", "samples", "share_devices"},
        "an entry of 'clusters'");
    for (const char* key : {"scene", json.contains("simulate") ? "simulate" : "ranks"})
        if (!json.contains(key))
            throw BadUsage("an entry of 'clusters' must have the key '" + std::string(key) + "'");
    if (json.contains("simulate") && json.contains("ranks"))
        throw BadUsage("'simulate' runs no 'ranks': an entry has one of the two");
    ClusterTask task;
    task.experiment = experiment;
    task.scene = text_at(json, "scene");
    task.words = words_of(json);
    read_number(json, "ranks", 1, ClusterTask::most_ranks, task.ranks);
    read_number(json, "simulate", 1, ClusterTask::most_ranks, task.simulates);
    read_number(json, "boxes", 1, ClusterTask::most_boxes, task.boxes);
    read_number(json, "rebalance", 1, ClusterTask::most_rebalance, task.rebalance);
    read_number(json, "samples", 1, ClusterTask::most_frames_timed, task.samples);
    CellChoice choice{.collider = task.pipeline.collider};
    read_choices(json, Choice::Of::query, choice);
    task.pipeline.collider = choice.collider;
    const auto text_of = [&](const char* key, std::string usual) {
        return json.contains(key) ? text_at(json, key) : std::move(usual);
    };
    BuilderChoice& builder = task.pipeline.builder;
    builder.name = text_of("builder", builder.name);
    builder.order = text_of("order", builder.order);
    task.pipeline.collider.name = text_of("collider", task.pipeline.collider.name);
    task.partition = partition_called(text_of("partition", "rcb"));
    task.check = cluster_check_called(text_of("check", "auto"));
    if (json.contains("frames"))
        task.frames = frame_range(text_at(json, "frames"));
    task.share_devices = json.contains("share_devices") && truth_at(json, "share_devices");
    check_task(task);
    return task;
}

}  // namespace bvhbench
