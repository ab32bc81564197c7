// SPDX-License-Identifier: MIT
#include "collide/skips.h"

#include <algorithm>
#include <iterator>
#include <sstream>

#include "geometry/names.h"

namespace bvhbench {
namespace {

constexpr std::string_view of_trees = "leaf group block bvtt";  // fronts keep their tree themselves

// A rule that costs more than it saves on a kind of device is not used there: `never`, or the triangles of a scene from which it
// saves time. docs/skips.md has the measurements. Colliders on the host go by the column of CPUs.
constexpr SkipRuleEntry rules[] = {
    {skip_unchanged, "unchanged",
     "an object of which no vertex has moved since the last frame keeps its tree", of_trees, always,
     always},
    {skip_rigid, "rigid",
     "an object that has moved rigidly keeps the order of its leaves, its boxes are refitted",
     of_trees, always, always},
    {skip_near, "near",
     "only triangles near another object's box enter a frame of pairs between objects",
     "leaf group block bvtt embree embree-refit fcl fcl-refit", always, 1u << 22},
    {skip_apart, "apart", "objects whose boxes are apart are not held against each other", of_trees,
     always, always},
    {skip_overlap, "overlap",
     "of two objects, only leaves near the other's box are held against it", "leaf group block",
     always, always},
    {skip_start_level, "start-level", "levels above the start level are not tested (bvtt)", "bvtt",
     always, always},
    {skip_empty_queue, "empty-queue",
     "steps that found their queue empty in the query before are not launched (bvtt, front)",
     "bvtt front", always, always},
    {skip_deforming, "deforming",
     "a deforming object keeps the order of its leaves while queries test hardly more boxes",
     of_trees, never, never},
    {skip_margin, "margin", "pairs found with room to move serve while each vertex is in its room",
     of_trees, never, never},
};

}  // namespace

bool SkipRuleEntry::applies_to(std::string_view collider) const
{
    std::istringstream words{std::string(colliders)};
    return std::find(std::istream_iterator<std::string>(words), {}, collider) !=
           std::istream_iterator<std::string>();
}

std::span<const SkipRuleEntry> skip_rules() { return rules; }

unsigned skip_rules_off(unsigned off, unsigned forced, bool on_cpu, std::size_t triangles)
{
    for (const SkipRuleEntry& entry : rules)
        if ((forced & entry.rule) == 0 && !entry.is_used(on_cpu, triangles))
            off |= entry.rule;
    return off;
}

unsigned skip_rules_called(std::string_view name)
{
    if (name != "all")
        return find_called(rules, name, "rule", "all").rule;
    unsigned all = 0;
    for (const SkipRuleEntry& entry : rules)
        all |= entry.rule;
    return all;
}

std::string skip_rules_text(unsigned called)
{
    std::string text;
    for (const SkipRuleEntry& entry : rules)
        if ((called & entry.rule) != 0)
            text += (text.empty() ? "" : ", ") + std::string(entry.name);
    return text;
}

}  // namespace bvhbench
