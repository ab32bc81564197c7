// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <string_view>

namespace bvhbench {

/// Rules that skip work a scene does not need. Each can be switched off; none changes the pairs found.
enum SkipRule : unsigned {
    skip_unchanged = 1u << 0,
    skip_rigid = 1u << 1,
    skip_apart = 1u << 2,
    skip_overlap = 1u << 3,
    skip_start_level = 1u << 4,
    skip_near = 1u << 5,
    skip_empty_queue = 1u << 6,
    skip_margin = 1u << 7,
    skip_deforming = 1u << 8,
};

/// From how many triangles of a scene a rule is used, where that does not depend on the scene.
inline constexpr std::size_t always = 0, never = std::numeric_limits<std::size_t>::max();

struct SkipRuleEntry {
    SkipRule rule;
    std::string_view name;     ///< key on the command line and in result files
    std::string_view summary;  ///< one line
    std::string_view
        colliders;  ///< names of the colliders whose frames it may shorten, "leaf group"
    /// Triangles of a scene from which the rule is used unless a user says otherwise, by the kind of device that does the work.
    std::size_t on_cpu_from = always, on_gpu_from = always;

    bool applies_to(std::string_view collider) const;
    bool is_used(bool on_cpu, std::size_t triangles) const
    {
        return triangles >= (on_cpu ? on_cpu_from : on_gpu_from);
    }
};

/// All rules, in the order of tables.
std::span<const SkipRuleEntry> skip_rules();

/// Returns the entry of one rule.
inline const SkipRuleEntry& skip_rule(SkipRule rule)
{
    return *std::ranges::find(skip_rules(), rule, &SkipRuleEntry::rule);
}

/// Returns the rule of that name, or every rule for "all". Throws BadUsage, with the known names, for an unknown one.
unsigned skip_rules_called(std::string_view name);

/// Returns the rules that a frame of `triangles` triangles does without: those of `off`, and those that the table leaves out on this
/// kind of device, except those of `forced`.
unsigned skip_rules_off(unsigned off, unsigned forced, bool on_cpu, std::size_t triangles);

/// Names of the rules, as in "rigid, apart".
std::string skip_rules_text(unsigned rules);

}  // namespace bvhbench
