// SPDX-License-Identifier: MIT
#include "harness/measure/view.h"

#include <algorithm>

#include "builders/spell_out.h"
#include "geometry/error.h"
#include "harness/base/number_text.h"
#include "harness/measure/collide.h"
#include "harness/record/provenance.h"

namespace bvhbench {
namespace {

/// A page with more triangles opens slowly, and its boxes hide each other.
constexpr std::size_t most_triangles = 100'000;

std::vector<uint> flat(const PairList& list)
{
    std::vector<uint> ids;
    ids.reserve(2 * list.size());
    for (const Pair pair : list.pairs())
        ids.insert(ids.end(), {pair.a, pair.b});
    return ids;
}

CollideTask task_of(const ViewTask& task)
{
    CollideTask collide;
    collide.experiment = "view";
    collide.scene = task.scene;
    collide.objects = ObjectsBy::one;
    collide.frames = {task.frame, task.frame + 1};
    collide.pipelines = {task.pipeline};
    collide.samples = 1;
    collide.warm_up = 0;
    return collide;
}

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
        append_list(text, sides);
        text += '}';
        now.swap(next);
    }
}

/// Returns the JSON text; "levels" is empty if `tree` is null.
std::string text_of(const std::string& run, const Cell& cell, const Scene& scene, std::size_t frame,
                    const HostTree* tree, const Found& found)
{
    std::string text = "{\"run\":" + run + ",\n\"cell\":" + cell_text(cell);
    const auto put = [&](const char* name, const auto& values) {
        text += std::string(",\n\"") + name + "\":";
        append_list(text, values);
    };
    std::vector<float> coordinates;
    for (const Point& point : scene.frames[frame])
        coordinates.insert(coordinates.end(), {point.x, point.y, point.z});
    std::vector<uint> corners;
    for (const Face& face : scene.faces)
        corners.insert(corners.end(), {face.a, face.b, face.c});
    put("points", coordinates);
    put("faces", corners);
    text += ",\n\"levels\":[";
    if (tree != nullptr)
        append_levels(text, *tree);
    text += ']';
    put("pairs", flat(found.pairs));
    put("contacts", flat(found.contacts));
    return text + "}\n";
}

}  // namespace

std::string view_text(Session& session, const ViewTask& task, std::vector<std::string> command)
{
    const CollideTask collide = task_of(task);
    const Scene scene = scene_of(collide, session.scenes());
    frames_of(collide, scene.frames.size(), "frames");
    if (scene.triangle_count() > most_triangles)
        throw BadUsage("a report shows scenes of up to " + std::to_string(most_triangles) +
                       " triangles in three dimensions, and '" + task.scene + "' has " +
                       std::to_string(scene.triangle_count()));
    const std::string run = run_text(run_facts(session.device(), std::move(command)));
    const std::vector<Point>& points = scene.frames[task.frame];
    const Input input = upload(session.device(), session.queue(), points, scene.faces);
    std::vector<Running> all;
    all.push_back({task.pipeline});
    Contest contest;
    const FrameOfPipelines frame{.input = input,
                                 .contest = contest,
                                 .number = "view",
                                 .scene = facts_of(collide, scene, task.frame)};
    int order = 0;
    Found found;
    Cell cell = run_frame(session, collide, all, frame, order, found).front();
    if (cell.status != Cell::Status::measured)
        throw Unavailable(cell.reason);
    const Tree* tree = all.front().pipeline->tree();
    if (tree == nullptr)
        throw BadUsage("a report shows the boxes of a builder's tree, and the collider " +
                       task.pipeline.collider.name + " has none");
    const HostTree spelled = tree->spelled_out();
    cell.samples.clear();
    cell.check.tree_hash = tree_hash(spelled);
    cell.check.against += ", contract";
    const std::string breach = broken_promise(spelled, points, scene.faces);
    if (!breach.empty())
        find_wrong(cell.check, breach);

    return text_of(run, cell, scene, task.frame, breach.empty() ? &spelled : nullptr, found);
}

}  // namespace bvhbench
