// SPDX-License-Identifier: MIT
#include <iostream>

#include "geometry/names.h"
#include "harness/base/table.h"
#include "harness/base/terminal.h"
#include "harness/commands/command.h"
#include "harness/commands/words.h"
#include "harness/measure/frames.h"
#include "harness/measure/planned_scenes.h"
#include "harness/record/output.h"
#include "scenes/facts.h"

namespace bvhbench {
namespace {

/// The number of triangles from which pairs are estimated, and the largest number of objects that the table names.
constexpr std::size_t sampled_triangles = 1024, most_objects = 8;

std::string short_number(double value)
{
    std::array<char, 40> text{};
    std::snprintf(text.data(), text.size(), "%.6g", value);
    return text.data();
}

std::string listed(const std::vector<std::string>& texts)
{
    return joined(std::vector<std::string_view>(texts.begin(), texts.end()));
}

std::string objects_text(const Scene& scene)
{
    std::vector<std::string> names;
    for (const SceneObject& object : scene.objects)
        if (names.size() < most_objects)
            names.push_back(object.name + ' ' + std::to_string(object.face_count));
    if (names.size() < scene.objects.size())
        names.emplace_back("...");
    return std::to_string(scene.objects.size()) + ": " + listed(names);
}

/// Returns the facts of a scene, one a line. Facts that are zero and usually are have no line.
Table facts_table(const Scene& scene)
{
    const MeshFacts& facts = *scene.facts;
    const Reading& reading = scene.reading;
    Table table({"<", "<"});
    const auto count_if = [&](const char* what, std::uint64_t count) {
        if (count > 0)
            table.row({what, std::to_string(count)});
    };
    table.row({"triangles", std::to_string(scene.faces.size())});
    table.row({"vertices", std::to_string(scene.frames.front().size())});
    count_if("  of no triangle", facts.unused_vertices);
    count_if("  that --weld would join", facts.weldable_vertices);
    count_if("  joined", reading.joined_vertices);
    table.row({"objects", objects_text(scene)});
    count_if("groups (--objects groups)", scene.groups.size());
    if (scene.frame_count() > 1)
        table.row({"frames", std::to_string(scene.frame_count()) +
                                 (scene.later.empty() ? "" : ", of different triangles")});
    table.row({"edges of two triangles", std::to_string(facts.shared_edges)});
    table.row({"  of one, open", std::to_string(facts.open_edges)});
    table.row({"  of more, non-manifold", std::to_string(facts.nonmanifold_edges)});
    count_if("triangles without area", facts.without_area);
    count_if("triangles with the corners of another", facts.duplicate);
    count_if("triangles in the place of another", facts.equal);
    count_if("polygons cut", reading.polygons_cut);
    count_if("  not convex, cut by ears", reading.polygons_concave);
    count_if("  that cross themselves", reading.polygons_crossing);
    const auto corner = [](const std::array<float, 3>& at) {
        return '(' + short_number(at[0]) + ", " + short_number(at[1]) + ", " + short_number(at[2]) +
               ')';
    };
    table.row({"extent", corner(facts.low) + " to " + corner(facts.high)});
    table.row({"step of floats there", short_number(facts.float_step)});
    table.row({"edges, median and longest",
               short_number(facts.median_edge) + ", " + short_number(facts.longest_edge)});
    table.row({"coordinates", rounding_text(scene.rounding)});
    table.row({"pairs of boxes, about", short_number(facts.expected_pairs)});
    if (!reading.ignored.empty())
        table.row({"not read", listed(reading.ignored)});
    if (const std::string line = surprises(scene); !line.empty())
        table.row({"surprises", line});
    return table;
}

class ShowScene final : public Command {
public:
    void add_options(CLI::App& app) override
    {
        app.add_option("SCENE", names_, "scenes, data sets, mesh files or folders")->required();
        app.add_option("--json", json_, "write the facts as JSON");
    }

    int run(const Invocation& invocation) override
    {
        const CommonOptions& common = invocation.common;
        SceneLibrary library = scene_library(common);
        library.tell = {};  // the table has it
        library.any_topology = true;
        const Output json(json_, "--json",
                          {.force = common.force, .inputs = files_of(names_, library)});
        std::string text;
        int code = 0;
        for (const std::string& name : names_) {
            const int failed = exit_code_of([&] {
                const std::string facts = facts_of_scene(name, library, common);
                text += (text.empty() ? "" : ",\n") + facts;
                return 0;
            });
            code = std::max(code, failed);
        }
        if (!json.is_nowhere() && !text.empty())
            json.replace("{\"scenes\": [\n" + text + "\n]}\n");
        return code;
    }

private:
    /// Prints the table of a scene and returns its facts as JSON.
    static std::string facts_of_scene(const std::string& name, const SceneLibrary& library,
                                      const CommonOptions& common)
    {
        Scene scene = load_scene(name, library);
        scene.facts = mesh_facts(scene, sampled_triangles);
        if (!common.quiet)
            std::cout << "scene " << scene.name << '\n'
                      << facts_table(scene).text(common.wide ? 0 : terminal_width()) << std::flush;
        return scene_text(facts_of(scene, scene.name, 0));
    }

    std::vector<std::string> names_;
    std::string json_;
};

}  // namespace

extern const CommandEntry scene_command = {
    "scene",
    knowing,
    "What reading a scene finds: its triangles, what they share, and what will surprise",
    "Measures nothing and needs no device. Of a folder, facts are those of its first frame. Pairs "
    "are estimated from 1,024 triangles. Exit code 3 if one of the scenes cannot be read; the "
    "others are.",
    {{"bvhbench scene part.stl", "one file"},
     {"bvhbench scene meshes/*.obj --json facts.json", "several, and the facts as JSON"}},
    "scenes/README.md",
    make_command<ShowScene>};

}  // namespace bvhbench
