// SPDX-License-Identifier: MIT
#include "harness/measure/view.h"

#include <algorithm>
#include <array>

#include "builders/spell_out.h"
#include "geometry/error.h"
#include "harness/base/number_text.h"
#include "harness/measure/frame_cells.h"
#include "harness/record/provenance.h"

namespace bvhbench {
namespace {

std::array<float, 6> sides_of(const Aabb& box)
{
    return {box.min_x, box.min_y, box.min_z, box.max_x, box.max_y, box.max_z};
}

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

}  // namespace

std::vector<ViewLevel> levels_of(const HostTree& tree)
{
    std::vector<ViewLevel> levels;
    std::vector<int> now = {0}, next;
    while (!now.empty()) {
        // Leaves last: a page then tells them by their number alone.
        std::stable_partition(now.begin(), now.end(), [&](int node) {
            return tree.nodes[node].primitive == HostTree::none;
        });
        ViewLevel& level = levels.emplace_back();
        level.boxes = now.size();
        next.clear();
        for (const int node : now) {
            const auto sides = sides_of(tree.nodes[node].box);
            level.sides.insert(level.sides.end(), sides.begin(), sides.end());
            level.leaves += tree.nodes[node].primitive != HostTree::none;
            for (const int child : tree.nodes[node].child)
                if (child != HostTree::none)
                    next.push_back(child);
        }
        now.swap(next);
    }
    return levels;
}

View view_of(Session& session, const ViewTask& task, std::vector<std::string> command)
{
    const CollideTask collide = task_of(task);
    const Scene scene = scene_of(collide, session.scenes());
    frames_of(collide, scene.frames.size(), "frames");
    if (scene.triangle_count() > most_view_triangles)
        throw BadUsage("a report shows scenes of up to " + std::to_string(most_view_triangles) +
                       " triangles in three dimensions, and '" + task.scene + "' has " +
                       std::to_string(scene.triangle_count()));
    View view{.run = run_facts(session.device(), std::move(command)),
              .cell = {},
              .points = scene.frames[task.frame],
              .faces = scene.faces,
              .levels = {},
              .pairs = {},
              .contacts = {}};
    const Input input = upload(session.device(), session.queue(), view.points, view.faces);
    std::vector<Running> all;
    all.push_back({task.pipeline});
    const FrameOfPipelines frame{
        .input = input, .number = "view", .scene = facts_of(collide, scene, task.frame)};
    int order = 0;
    Found found;
    view.cell = run_frame(session, collide, all, frame, order, found).front();
    if (view.cell.status != Cell::Status::measured)
        throw Unavailable(view.cell.reason);
    const Tree* tree = all.front().pipeline->tree();
    if (tree == nullptr)
        throw BadUsage("a report shows the boxes of a builder's tree, and the collider " +
                       task.pipeline.collider.name + " has none");
    const HostTree spelled = tree->spelled_out();
    view.cell.samples.clear();
    view.cell.check.tree_hash = tree_hash(spelled);
    view.cell.check.against += ", contract";
    if (const std::string breach = broken_promise(spelled, view.points, view.faces);
        !breach.empty())
        find_wrong(view.cell.check, breach);
    else
        view.levels = levels_of(spelled);
    view.pairs = std::move(found.pairs);
    view.contacts = std::move(found.contacts);
    return view;
}

std::string view_text(const View& view)
{
    std::string text = "{\"run\":" + run_text(view.run) + ",\n\"cell\":" + cell_text(view.cell);
    const auto put = [&](const char* name, const auto& values) {
        text += std::string(",\n\"") + name + "\":";
        append_list(text, values);
    };
    std::vector<float> coordinates;
    for (const Point& point : view.points)
        coordinates.insert(coordinates.end(), {point.x, point.y, point.z});
    std::vector<uint> corners;
    for (const Face& face : view.faces)
        corners.insert(corners.end(), {face.a, face.b, face.c});
    put("points", coordinates);
    put("faces", corners);
    text += ",\n\"levels\":[";
    for (const ViewLevel& level : view.levels) {
        text += &level == &view.levels.front() ? "\n{\"leaves\":" : ",\n{\"leaves\":";
        append_number(text, level.leaves);
        text += ",\"boxes\":";
        append_list(text, level.sides);
        text += '}';
    }
    text += ']';
    put("pairs", flat(view.pairs));
    put("contacts", flat(view.contacts));
    return text + "}\n";
}

}  // namespace bvhbench
