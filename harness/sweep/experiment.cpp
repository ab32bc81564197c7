// SPDX-License-Identifier: MIT
#include "harness/sweep/experiment.h"

namespace bvhbench {
namespace {

Json json_of(const BuilderChoice& builder)
{
    return {{"name", builder.name},
            {"order", builder.order},
            {"grid", builder.grid == GridOver::scene ? "scene" : "object"},
            {"group_size", builder.group_size},
            {"items", builder.items},
            {"leaves", builder.sorted_leaves ? "sorted" : "mesh"},
            {"boxes", builder.boxes}};
}

Json pipeline_of(const SweepCell& cell)
{
    const ColliderChoice& collider = cell.collider;
    Json pipeline = {{"collider",
                      {{"name", collider.name},
                       {"jump", collider.jump},
                       {"start_level", collider.start_level},
                       {"group_size", collider.group_size}}},
                     {"pairs_of", among_name(collider.among)},
                     {"adjacent", collider.keep_adjacent ? "keep" : "drop"},
                     {"narrow", collider.narrow}};
    if (cell.builder.name != "none")
        pipeline["builder"] = json_of(cell.builder);
    if (collider.rules_off != 0) {
        const std::string all = "all";
        pipeline["no_skip"] = collider.rules_off == skip_rules_called({&all, 1})
                                  ? all
                                  : skip_rules_text(collider.rules_off);
    }
    return pipeline;
}

}  // namespace

Json experiment_of(const Sweep& sweep, const std::vector<SweepCell>& cells)
{
    const bool collides = cells.front().collides();
    Json experiment = {{"experiment", sweep.name}};
    if (!sweep.question.empty())
        experiment["question"] = sweep.question;
    experiment["scenes"] =
        Json::array({collides ? cells.front().scene : cells.front().scene.at("scene")});
    Json& list = experiment[collides ? "pipelines" : "builders"] = Json::array();
    for (const SweepCell& cell : cells)
        list.push_back(collides ? pipeline_of(cell) : json_of(cell.builder));
    experiment["samples"] = sweep.samples;
    experiment["warm_up"] = sweep.warm_up;
    if (!collides)
        experiment["quality"] = sweep.quality;
    return experiment;
}

std::string told(const SweepCell& cell)
{
    return cell.scene_name() + '\n' + json_of(cell.builder).dump() +
           (cell.collides() ? pipeline_of(cell).dump() : "");
}

}  // namespace bvhbench
