// SPDX-License-Identifier: MIT
#include "harness/measure/planned_scenes.h"

#include <algorithm>
#include <iterator>

#include "geometry/error.h"
#include "geometry/hash.h"
#include "harness/base/failure.h"
#include "harness/measure/collide.h"
#include "harness/record/cluster_result.h"

namespace bvhbench {
namespace {

/// Cost of a process's start, in triangles.
constexpr std::size_t triangles_of_a_start = 100'000;

/// Returns what a filter is held against.
std::string text_of(const std::string& scene, const PipelineChoice& pipeline)
{
    return scene + '/' + pipeline.builder.name + '/' + pipeline.collider.name;
}

}  // namespace

std::vector<std::string> files_of(const std::vector<std::string>& scenes,
                                  const SceneLibrary& library)
{
    std::vector<std::string> files;
    for (const std::string& scene : scenes)
        std::ranges::move(scene_files(scene, library), std::back_inserter(files));
    return files;
}

CellFilter cell_filter(const std::string& text, const char* option)
{
    if (text.empty())
        return {};
    auto filter = std::make_shared<const re2::RE2>(text, re2::RE2::Quiet);
    if (!filter->ok())
        throw BadUsage(std::string(option) + ": '" + text + "' is no regular expression: " +
                       filter->error().substr(0, filter->error().find(':')));
    return filter;
}

bool passes(const CellFilter& filter, const std::string& cell)
{
    return filter == nullptr || re2::RE2::PartialMatch(cell, *filter);
}

std::vector<PlannedScene> planned_scenes(const RunPlan& plan, const CellFilter& filter,
                                         const PlanShare& share, const std::string& settings)
{
    std::vector<PlannedScene> found;
    std::size_t number = 0;
    const auto add = [&](const Experiment& experiment, const std::string& name, std::size_t cells,
                         const CollideTask* task, const ClusterTask* cluster = nullptr) {
        PlannedScene planned{&experiment, number, task, cluster, name, "", 0};
        if (!share.has(number++) || cells == 0)
            return;
        std::size_t triangles = 0;
        reason_of_failure([&] { triangles = triangles_in_name(name); });
        planned.weight = static_cast<double>(cells * (triangles + triangles_of_a_start));
        if (!settings.empty()) {
            Hash hash;
            for (const std::string& text : {settings, experiment.source, name})
                hash.bytes(text.c_str(), text.size() + 1);
            // An experiment may have a scene twice, with other frames or as builds and as pipelines.
            hash.value(plan.has_parts ? 0 : planned.number);
            planned.key = hex(hash.get());
        }
        found.push_back(std::move(planned));
    };
    for (const Experiment& experiment : plan.parts) {
        for (const CollideTask& task : experiment.collisions)
            add(experiment, task.scene, chosen(task, filter).size(), &task);
        for (const std::string& name : experiment.scenes)
            add(experiment, name, chosen(experiment, name, filter).size(), nullptr);
        for (const ClusterTask& task : experiment.clusters)
            add(experiment, task.scene, passes(filter, text_of(task.scene, task.pipeline)) ? 1 : 0,
                nullptr, &task);
    }
    return found;
}

std::vector<PipelineChoice> chosen(const CollideTask& task, const CellFilter& filter)
{
    std::vector<PipelineChoice> pipelines = task.pipelines;
    std::erase_if(pipelines, [&](const PipelineChoice& pipeline) {
        return !passes(filter, text_of(task.scene, pipeline));
    });
    return pipelines;
}

std::vector<BuilderChoice> chosen(const Experiment& experiment, const std::string& scene,
                                  const CellFilter& filter)
{
    std::vector<BuilderChoice> builders = experiment.builders;
    std::erase_if(builders, [&](const BuilderChoice& builder) {
        return !passes(filter, scene + '/' + builder.name);
    });
    return builders;
}

std::vector<Cell> planned_cells(const PlannedScene& planned, const CellFilter& filter)
{
    std::vector<Cell> cells;
    if (planned.cluster != nullptr)
        cells.push_back(planned_cell(*planned.cluster));
    else if (planned.collides != nullptr)
        for (const PipelineChoice& pipeline : chosen(*planned.collides, filter)) {
            Cell& cell = cells.emplace_back(planned_cell(*planned.collides, pipeline));
            if (!find_collider(cell.collider.name).needs_tree)
                cell.builder = {.name = "none"};
            cell.collider.keep_adjacent =
                cell.collider.keep_adjacent && !planned.collides->has_features();
        }
    else
        for (const BuilderChoice& builder : chosen(*planned.experiment, planned.name, filter))
            cells.push_back({.experiment = planned.experiment->name,
                             .scene = {.name = planned.name},
                             .builder = builder});
    for (Cell& cell : cells)
        cell.status = Cell::Status::skipped;
    return cells;
}

}  // namespace bvhbench
