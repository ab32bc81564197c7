// SPDX-License-Identifier: MIT
#include <algorithm>

#include "builders/host_tree.h"
#include "geometry/error.h"
#include "harness/base/json_keys.h"
#include "harness/measure/collide.h"
#include "harness/record/provenance.h"

namespace bvhbench {
namespace {

/// A page with more triangles opens slowly, and its boxes hide each other.
constexpr std::size_t most_triangles = 100'000;

/// Appends the boxes of a valid tree, level by level. Padding nodes, which are no node's child, are on no level.
void append_levels(std::string& text, const HostTree& tree)
{
    std::vector<int> now = {0}, next;
    for (const char* start = "\n{\"leaves\":"; !now.empty(); start = ",\n{\"leaves\":") {
        // Leaves come last, so that their number alone separates them from inner nodes.
        const auto leaves = std::stable_partition(now.begin(), now.end(), [&](int node) {
            return tree.nodes[node].primitive == HostTree::none;
        });
        text += start + std::to_string(now.end() - leaves) + ",\"boxes\":";
        std::vector<float> sides;
        next.clear();
        for (const int node : now) {
            const auto& [box, children, primitive] = tree.nodes[node];
            sides.insert(sides.end(),
                         {box.min_x, box.min_y, box.min_z, box.max_x, box.max_y, box.max_z});
            for (const int child : children)
                if (child != HostTree::none)
                    next.push_back(child);
        }
        text += FloatJson(sides).dump() + '}';
        now.swap(next);
    }
}

/// Returns the JSON text; "levels" is empty if `tree` is null.
std::string text_of(const Json& run, const Cell& cell, const Scene& scene, std::size_t frame,
                    const HostTree* tree, const Found& found)
{
    std::string text = "{\"run\":" + one_line(run) + ",\n\"cell\":" + cell_text(cell);
    const auto put = [&](const char* name, const auto& items, const auto... members) {
        std::vector<std::common_type_t<decltype(items[0].*members)...>> flat;
        for (const auto& item : items)
            flat.insert(flat.end(), {item.*members...});
        text += std::string(",\n\"") + name + "\":" + FloatJson(flat).dump();
    };
    put("points", scene.frames[frame], &Point::x, &Point::y, &Point::z);
    put("faces", scene.faces, &Face::a, &Face::b, &Face::c);
    text += ",\n\"levels\":[";
    if (tree != nullptr)
        append_levels(text, *tree);
    text += ']';
    put("pairs", found.pairs.pairs(), &Pair::a, &Pair::b);
    put("contacts", found.contacts.pairs(), &Pair::a, &Pair::b);
    return text + "}\n";
}

}  // namespace

std::string view_text(Session& session, const std::string& scene_name, std::size_t number,
                      const PipelineChoice& pipeline, std::vector<std::string> command)
{
    CollideTask task;
    task.experiment = "view";
    task.scene = scene_name;
    task.objects = ObjectsBy::one;
    task.frames = {number, number + 1};
    task.samples = 1;
    task.warm_up = 0;
    const Scene scene = scene_of(task, session.scenes());
    frames_of(task, scene.frames.size(), "frames");
    if (scene.triangle_count() > most_triangles)
        throw BadUsage("a report shows scenes of up to " + std::to_string(most_triangles) +
                       " triangles in three dimensions, and '" + scene_name + "' has " +
                       std::to_string(scene.triangle_count()));
    const Json run = run_facts(session.device(), std::move(command));
    const std::vector<Point>& points = scene.frames[number];
    const Input input = upload(session.device(), session.queue(), points, scene.faces);
    PipelineState state{pipeline};
    Contest contest;
    const FrameOfPipelines frame{.input = input,
                                 .contest = contest,
                                 .number = "view",
                                 .scene = facts_of(task, scene, number),
                                 .wants_lists = true};
    int order = 0;
    Found found;
    Cell cell = run_frame(session, task, {&state, 1}, frame, order, found).front();
    if (cell.status != Cell::Status::measured)
        throw Unavailable(cell.reason);
    const Tree* tree = state.pipeline->tree();
    if (tree == nullptr)
        throw BadUsage("a report shows the boxes of a builder's tree, and the collider " +
                       pipeline.collider.name + " has none");
    const HostTree spelled = tree->to_host_tree();
    cell.samples.clear();
    cell.check.tree_hash = tree_hash(spelled);
    cell.check.against += ", contract";
    const std::string violation = invariant_violation(spelled, points, scene.faces);
    if (!violation.empty())
        cell.check.find_wrong(violation);

    return text_of(run, cell, scene, number, violation.empty() ? &spelled : nullptr, found);
}

}  // namespace bvhbench
