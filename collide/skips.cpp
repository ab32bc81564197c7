// SPDX-License-Identifier: MIT
#include "collide/skips.h"

#include "geometry/names.h"

namespace bvhbench {
namespace {

constexpr SkipRuleEntry rules[] = {
    {skip_unchanged, "unchanged",
     "an object of which no vertex has moved since the last frame keeps its tree"},
    {skip_rigid, "rigid",
     "an object that has moved rigidly keeps the order of its leaves, its boxes are refitted"},
    {skip_near, "near",
     "only triangles near another object's box enter a frame of pairs between objects"},
    {skip_apart, "apart", "objects whose boxes are apart are not held against each other"},
    {skip_overlap, "overlap",
     "of two objects, only leaves near the other's box are held against it"},
    {skip_start_level, "start-level", "levels above the start level are not tested (bvtt)"},
    {skip_empty_queue, "empty-queue",
     "steps that found their queue empty in the query before are not launched (bvtt)"},
};

}  // namespace

std::span<const SkipRuleEntry> skip_rules() { return rules; }

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
