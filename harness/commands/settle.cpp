// SPDX-License-Identifier: MIT
//
// What the commands that are written in Python ask the program for: the facts of the device, and what cells experiments have.
#include <iostream>
#include <iterator>

#include "geometry/error.h"
#include "harness/base/json_keys.h"
#include "harness/choice/choices.h"
#include "harness/choice/experiment.h"
#include "harness/commands/command.h"
#include "harness/measure/run.h"
#include "harness/session/session.h"

namespace bvhbench {
namespace {

/// A cell of an experiment before anything is known of its scene.
Cell planned(const std::string& experiment, const std::string& scene, const BuilderChoice& builder)
{
    Cell cell;
    cell.experiment = experiment;
    cell.scene.name = scene;
    cell.builder = builder;
    cell.status = Cell::Status::skipped;
    return cell;
}

std::vector<Cell> planned_cells(const Experiment& experiment)
{
    std::vector<Cell> cells;
    for (const std::string& scene : experiment.scenes)
        for (const BuilderChoice& builder : experiment.builders)
            cells.push_back(planned(experiment.name, scene, builder));
    for (const CollideTask& task : experiment.collisions)
        for (const PipelineChoice& pipeline : task.pipelines) {
            cells.push_back(planned(experiment.name, task.scene, pipeline.builder));
            Cell& cell = cells.back();
            cell.operation = Operation::collide;
            cell.collider = pipeline.collider;
            if (!find_collider(cell.collider.name).needs_tree)
                cell.builder = {.name = "none"};
            if (task.swept)
                cell.collider.keep_adjacent = false;
            cell.scene.between = task.between;
            if (task.objects != ObjectsBy::automatic)
                cell.scene.objects_by = objects_by_name(task.objects);
        }
    return cells;
}

/// What is wrong with a scene's name; empty if nothing is.
std::string why_not(const std::string& scene)
{
    try {
        triangles_said(scene);
        return {};
    } catch (const BadUsage& error) {
        return error.what();
    }
}

/// An experiment's cells, their scene's triangles as far as its name tells, and its files; or what is wrong with it.
Json settled(const Json& described, const SceneLibrary& library)
{
    try {
        const Experiment experiment = parse_experiment(described.dump(), "", false);
        Json cells = Json::array(), files = Json::array();
        const std::vector<Cell> planned = planned_cells(experiment);
        for (const Cell& cell : planned) {
            check_powers({cell.builder, cell.collider});
            cells.push_back(Json::parse(cell_text(cell)));
        }
        const std::string& scene = planned.front().scene.name;
        if (is_sized_generator(scene))
            return {{"sized", true}, {"error", why_not(scene)}};
        const std::size_t triangles = triangles_said(scene);
        for (const std::string& file : scene_files(scene, library))
            files.push_back(file);
        return {{"cells", cells}, {"triangles", triangles}, {"files", files}};
    } catch (const BadUsage& error) {
        const std::string sentence = error.what();
        return {{"error", sentence.starts_with(": ") ? sentence.substr(2) : sentence}};
    }
}

class Facts final : public Command {
public:
    void add_options(CLI::App&) override {}

    int run(const Invocation& invocation) override
    {
        Session session(invocation.common);
        std::cout << "{\"format\": \"" << result_format
                  << "\", \"run\": " << run_text(measured_facts(session, {})) << "}\n";
        return 0;
    }
};

class Settle final : public Command {
public:
    void add_options(CLI::App&) override {}

    int run(const Invocation& invocation) override
    {
        const std::string text(std::istreambuf_iterator<char>(std::cin), {});
        Json answers = Json::array();
        for (const Json& described : Json::parse(text))
            answers.push_back(settled(described, scene_library(invocation.common)));
        std::cout << answers.dump() << '\n';
        return 0;
    }
};

}  // namespace

extern const CommandEntry facts_command = {
    "facts",
    {},
    "What is known of the device and of a run on it, as JSON",
    {},
    {},
    {},
    make_command<Facts>};

extern const CommandEntry settle_command = {
    "settle",
    {},
    "The cells of experiments on standard input, or what is wrong with them, as JSON",
    {},
    {},
    {},
    make_command<Settle>};

}  // namespace bvhbench
