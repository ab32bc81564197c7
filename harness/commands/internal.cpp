// SPDX-License-Identifier: MIT
//
// Internal commands for those written in Python. They return device facts, the cells of experiments, and the data for drawing
// a scene in three dimensions.
#include <algorithm>
#include <iostream>
#include <iterator>

#include "geometry/error.h"
#include "geometry/names.h"
#include "harness/base/failure.h"
#include "harness/base/json_keys.h"
#include "harness/choice/choices.h"
#include "harness/choice/experiment.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"
#include "harness/measure/collide.h"
#include "harness/measure/run.h"
#include "harness/session/session.h"

namespace bvhbench {
namespace {

/// Returns an experiment's cells, input files, and number of triangles (0 if only loading the scene tells it). Returns `error`
/// for an invalid experiment, with `sized` if its scene is a generator without a size.
Json expanded(const Json& described, const SceneLibrary& library)
{
    try {
        const RunPlan plan{.name = {}, .parts = {parse_experiment(described.dump(), "", false)}};
        std::vector<Cell> planned;  // without loading scenes
        for (const PlannedScene& scene : planned_scenes(plan, {}, {}, ""))
            std::ranges::move(planned_cells(scene, {}), std::back_inserter(planned));
        Json cells = Json::array();
        for (Cell& cell : planned) {
            check_powers({cell.builder, cell.collider});
            if (const BuilderEntry* entry = find_name(builder_catalog(), cell.builder.name);
                entry != nullptr && entry->own_order)
                cell.builder.order = BuildOptions().order;  // the same tree in each order
            cells.push_back(Json::parse(cell_text(cell)));
        }
        const std::string& scene = planned.front().scene.name;
        if (is_sized_generator(scene))
            return {{"sized", true},
                    {"error", reason_of_failure([&] { triangles_in_name(scene); })}};
        return {{"cells", cells},
                {"triangles", triangles_in_name(scene)},
                {"files", scene_files(scene, library)}};
    } catch (const BadUsage& error) {
        return {{"error", error.what()}};
    }
}

class Facts final : public Command {
public:
    int run(const Invocation& invocation) override
    {
        Session session(invocation.common);
        std::cout << "{\"format\": \"" << result_format
                  << "\", \"run\": " << one_line(measured_facts(session, {})) << "}\n";
        return 0;
    }
};

class Expand final : public Command {
public:
    int run(const Invocation& invocation) override
    {
        Json answers = Json::array();
        for (const Json& described : Json::parse(std::cin))
            answers.push_back(expanded(described, scene_library(invocation.common)));
        std::cout << answers.dump() << '\n';
        return 0;
    }
};

class ViewCommand final : public Command {
public:
    void add_options(CLI::App& app) override
    {
        app.add_option("--scene", scene_)->required();
        app.add_option("--frame", frame_);
        app.add_option("--builder", choice_.builder.name);
        app.add_option("--collider", choice_.collider.name);
        add_choices(app, choice_,
                    [](const Choice& option) { return option.of == Choice::Of::builder; });
    }

    int run(const Invocation& invocation) override
    {
        check_choice(choice_);
        check_powers(choice_);
        Session session(invocation.common);
        std::cout << view_text(session, scene_, frame_, {choice_.builder, choice_.collider},
                               invocation.words);
        return 0;
    }

private:
    std::string scene_;
    unsigned frame_ = 0;
    CellChoice choice_{.builder = {.name = "oibvh-multi"},
                       .collider = {{.keep_adjacent = false}, "leaf", "exact"}};
};

}  // namespace

extern const CommandEntry facts_command = {
    .name = "facts",
    .summary = "What is known of the device and of a run on it, as JSON",
    .make = make_command<Facts>};

extern const CommandEntry expand_command = {
    .name = "expand",
    .summary = "The cells of experiments on standard input, or what is wrong with them, as JSON",
    .make = make_command<Expand>};

extern const CommandEntry view_command = {
    .name = "view",
    .summary = "A frame with a builder's boxes and a collider's pairs, as JSON",
    .make = make_command<ViewCommand>};

}  // namespace bvhbench
