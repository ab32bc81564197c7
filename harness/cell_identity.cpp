// SPDX-License-Identifier: MIT
#include "harness/cell_identity.h"

#include <algorithm>
#include <map>

#include "harness/report.h"

namespace bvhbench {

std::string identity_text(const Cell& cell)
{
    std::string text;
    const auto add = [&](const std::string& part) { text += part + '\n'; };
    add(cell.experiment);
    add(cell.scene.name);
    add(std::to_string(cell.scene.frame));
    add(cell.scene.stand_in_for);
    add(cell.scene.objects_by + ' ' + std::to_string(cell.scene.between));
    add(std::string(operation_name(cell.operation)));
    add(cell.builder.name + ' ' + cell.builder.order + ' ' + cell.builder.boxes + ' ' +
        (cell.builder.grid == GridOver::scene ? "scene" : "object") + ' ' +
        (cell.builder.sorted_leaves ? "sorted" : "mesh") + ' ' +
        std::to_string(cell.builder.group_size) + ' ' + std::to_string(cell.builder.items));
    const ColliderChoice& collider = cell.collider;
    if (!collider.name.empty())
        add(collider.name + ' ' + std::string(among_name(collider.among)) + ' ' +
            (collider.keep_adjacent ? "keep" : "drop") + ' ' + collider.narrow + ' ' +
            std::to_string(collider.jump) + ' ' + std::to_string(collider.start_level) + ' ' +
            std::to_string(collider.group_size) + ' ' + std::to_string(collider.rules_off));
    if (cell.sampling.cold)
        add("cold");
    if (!cell.swept.pairs.empty())
        add(cell.swept.pairs + ' ' + std::to_string(cell.swept.to_frame));
    if (!cell.accuracy.axis.empty())
        add(cell.accuracy.axis + ' ' + cell.accuracy.method + ' ' +
            std::to_string(cell.accuracy.seed));
    return text;
}

bool starts_from_leaves(const Cell& cell)
{
    return cell.operation == Operation::build && !cell.samples.empty() &&
           cell.samples.front().stages.size() == 1 &&
           cell.samples.front().stages.front().stage == "hierarchy" &&
           cell.samples.front().stages.front().launches > 0;
}

MatchedCells matched_cells(const std::vector<Cell>& first, const std::vector<Cell>& second)
{
    std::map<std::string, std::vector<const Cell*>> there;
    for (const Cell& cell : second)
        there[identity_text(cell)].push_back(&cell);
    MatchedCells matched;
    for (const Cell& cell : first) {
        std::vector<const Cell*>& candidates = there[identity_text(cell)];
        // A cell without samples does not tell what they would have begun with.
        const auto found =
            std::find_if(candidates.begin(), candidates.end(), [&](const Cell* other) {
                return cell.samples.empty() || other->samples.empty() ||
                       starts_from_leaves(cell) == starts_from_leaves(*other);
            });
        if (found == candidates.end()) {
            matched.only_first.push_back(&cell);
            continue;
        }
        matched.both.emplace_back(&cell, *found);
        candidates.erase(found);
    }
    for (const Cell& cell : second) {  // in its own order
        const auto left = there.find(identity_text(cell));
        if (std::find(left->second.begin(), left->second.end(), &cell) != left->second.end())
            matched.only_second.push_back(&cell);
    }
    return matched;
}

std::string scene_label(const SceneFacts& scene)
{
    return scene.name + (scene.objects_by.empty() ? "" : ", objects: " + scene.objects_by) +
           (scene.between == 0 ? "" : ", " + std::to_string(scene.between) + " between");
}

std::string cell_label(const Cell& cell)
{
    std::string text = scene_label(cell.scene);
    if (cell.operation == Operation::collide || cell.scene.frame > 0)
        text += ", frame " + std::to_string(cell.scene.frame);
    text += ": " + pipeline_text(cell);
    return text + (starts_from_leaves(cell) ? ", from sorted leaves" : "");
}

}  // namespace bvhbench
