// SPDX-License-Identifier: MIT
#pragma once

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
};

struct SkipRuleEntry {
    SkipRule rule;
    std::string_view name;     ///< key on the command line and in result files
    std::string_view summary;  ///< one line
};

/// All rules, in the order of tables.
std::span<const SkipRuleEntry> skip_rules();

/// Returns the rule of that name, or every rule for "all". Throws BadUsage, with the known names, for an unknown one.
unsigned skip_rules_called(std::string_view name);

/// Names of the rules, as in "rigid, apart".
std::string skip_rules_text(unsigned rules);

}  // namespace bvhbench
