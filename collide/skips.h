// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace bvhbench {

/// Work that a scene does not need, as rules: each can be switched off, and none of them changes what is found.
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
    std::string_view name;     ///< the key on the command line and in result files
    std::string_view summary;  ///< one line
};

/// Every rule, in the order tables list them.
std::span<const SkipRuleEntry> skip_rules();

/// Rules by their names, "all" for all of them. Throws BadUsage with the known names.
unsigned skip_rules_called(std::span<const std::string> names);

/// "rigid, apart"
std::string skip_rules_text(unsigned rules);

}  // namespace bvhbench
