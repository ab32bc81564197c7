// SPDX-License-Identifier: MIT
#include "harness/choice/scene_choice.h"

#include <re2/re2.h>

#include <algorithm>

#include "builders/orders.h"
#include "collide/narrow/narrow_methods.h"
#include "geometry/error.h"

namespace bvhbench {

std::vector<PipelineChoice> with_each_rule_off(const std::vector<PipelineChoice>& pipelines)
{
    std::vector<PipelineChoice> all;
    for (const PipelineChoice& pipeline : pipelines) {
        all.push_back(pipeline);
        const ColliderChoice& collider = pipeline.collider;
        ColliderChoice without_any = collider;
        int rules = 0;
        for (const SkipRuleEntry& entry : skip_rules()) {
            if (!entry.applies_to(collider.name) || (collider.rules_off & entry.rule) != 0)
                continue;
            ++rules;
            for (ColliderChoice* one : {&without_any, &all.emplace_back(pipeline).collider}) {
                one->rules_forced &= ~entry.rule;
                one->rules_off |= entry.rule;
            }
            const bool on_device = find_collider(collider.name).needs_tree;
            if (on_device && std::max(entry.on_cpu_from, entry.on_gpu_from) != always &&
                (collider.rules_forced & entry.rule) == 0) {
                all.push_back(pipeline);
                all.back().collider.rules_forced |= entry.rule;
            }
        }
        if (rules > 1)
            all.push_back({pipeline.builder, without_any});
    }
    return all;
}

FrameRange frame_range(const std::string& text)
{
    FrameRange range;
    std::string end;
    if (!RE2::FullMatch(text, "(\\d{1,9})((?::\\d{0,9})?)", &range.first, &end))
        throw BadUsage("frames are given as a:b, from a to before b, not as '" + text + "'");
    if (end.empty())
        return {range.first, range.first + 1};
    range.end = 0;
    if (RE2::FullMatch(end, ":(\\d+)", &range.end) && range.end <= range.first)
        throw BadUsage("frames " + text + " are none");
    return range;
}

std::string frame_range_text(const FrameRange& range)
{
    return std::to_string(range.first) + ':' + (range.end == 0 ? "" : std::to_string(range.end));
}

void check_features(const CollideTask& task)
{
    for (const PipelineChoice& pipeline : task.pipelines) {
        check_narrow_of(pipeline.collider.narrow, pipeline.collider.question(task.swept));
        if (pipeline.collider.separation != "none")
            check_separation(pipeline.collider.narrow, task.swept);
    }
    if (!task.has_features())
        return;
    if (task.swept && task.features)
        throw BadUsage("'features' are of one moment, and 'swept' has those between two");
    const std::string what = task.swept ? "swept" : "with 'features'";
    if (task.objects != ObjectsBy::automatic)
        throw BadUsage(
            what + ", objects are the scene's vertices, faces and edges, and nobody chooses them");
    if (!task.exclude.empty())
        throw BadUsage(what +
                       ", objects are the scene's vertices, faces and edges, and 'exclude' is "
                       "about those of the scene");
    for (const PipelineChoice& pipeline : task.pipelines) {
        if (pipeline.collider.first)
            throw BadUsage("'first' is about triangles, and " + what +
                           " pairs are of vertices, faces and edges");
        if (task.swept && pipeline.collider.is_within())
            throw BadUsage(
                "'within' is about one moment, and swept boxes are not: there are 'features'");
        if (task.features && !pipeline.collider.is_within())
            throw BadUsage("'features' are pairs at most a distance apart: they need 'within'");
        if (pipeline.collider.among != Among::within_objects && pipeline.builder.name != "none" &&
            find_order(pipeline.builder.order).medians != Medians::nowhere)
            throw BadUsage("order " + pipeline.builder.order +
                           " lines up one object, and vertices and faces are two: pairs "
                           "within objects are those of edges alone");
    }
}

}  // namespace bvhbench
