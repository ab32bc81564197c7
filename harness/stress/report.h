// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/stress/finding.h"

namespace bvhbench {

/// Stress cells as tables for the console: scenes with who was right over them, systems with their invariants, and
/// whatever of ours is wrong, in a line each. `versions` are the libraries', by name.
std::string stress_report(const std::vector<StressCell>& cells,
                          const std::map<std::string, std::string>& versions);

}  // namespace bvhbench
