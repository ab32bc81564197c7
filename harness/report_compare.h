// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "harness/compare.h"

namespace bvhbench {

/// Two files side by side: cells whose time changed or may have, worst first, with their stages; all other changes a line
/// each; and how many cells came out how. With `all`, the table has every cell.
std::string comparison_report(const Comparison& comparison, bool all = false);

}  // namespace bvhbench
