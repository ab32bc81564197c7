// SPDX-License-Identifier: MIT
#include "harness/choice/cluster_task.h"

#include <bit>

#include "builders/orders.h"
#include "collide/narrow/narrow_methods.h"
#include "geometry/error.h"
#include "harness/choice/choices.h"
#include "scenes/catalog.h"

namespace bvhbench {
namespace {

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

void check_task(const ClusterTask& task)
{
    check_choice({task.pipeline.builder, task.pipeline.collider});
    check_narrow_of(task.pipeline.collider.narrow, task.pipeline.collider.question(false));
    if (task.simulates != 0 && task.is_within())
        throw BadUsage("what ranks would send is counted for overlapping boxes, without 'within'");
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
         "narrow", "within", "boxes", "frames", "rebalance", "check", "samples", "share_devices"},
        "an entry of 'clusters'");
    for (const char* key : {"scene", json.contains("simulate") ? "simulate" : "ranks"})
        if (!json.contains(key))
            throw BadUsage("an entry of 'clusters' must have the key '" + std::string(key) + "'");
    if (json.contains("simulate") && json.contains("ranks"))
        throw BadUsage("'simulate' runs no 'ranks': an entry has one of the two");
    ClusterTask task;
    task.experiment = experiment;
    task.scene = text_at(json, "scene");
    read_number(json, "ranks", 1, ClusterTask::most_ranks, task.ranks);
    read_number(json, "simulate", 1, ClusterTask::most_ranks, task.simulates);
    read_number(json, "boxes", 1, ClusterTask::most_boxes, task.boxes);
    read_number(json, "rebalance", 1, ClusterTask::most_rebalance, task.rebalance);
    read_number(json, "samples", 1, ClusterTask::most_frames_timed, task.samples);
    CellChoice choice{.collider = task.pipeline.collider};
    read_choices(json, Choice::Of::query, choice);
    task.pipeline.collider = choice.collider;
    BuilderChoice& builder = task.pipeline.builder;
    builder.name = text_in(json, "builder", builder.name);
    builder.order = text_in(json, "order", builder.order);
    task.pipeline.collider.name = text_in(json, "collider", task.pipeline.collider.name);
    Json whole = json;  // `cluster` chooses what is left out by device
    whole.update({{"builder", builder.name},
                  {"order", builder.order},
                  {"collider", task.pipeline.collider.name}});
    task.words = words_of(whole);
    task.partition =
        value_called<PartitionBy>("partition", text_in(json, "partition", "rcb"), partition_names);
    task.check =
        value_called<ClusterCheck>("check", text_in(json, "check", "auto"), cluster_check_names);
    if (json.contains("frames"))
        task.frames = frame_range(text_at(json, "frames"));
    task.share_devices = is_true(json, "share_devices");
    check_task(task);
    return task;
}

}  // namespace bvhbench
