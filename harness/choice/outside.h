// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "harness/base/common_options.h"

namespace bvhbench {

/// Starts each plug-in of --plugin, BVHBENCH_PLUGINS and --program, and adds what it says it has to the catalogs. Returns a sentence for
/// each that does not start or has a name that is taken; its cells fail with that sentence.
std::vector<std::string> start_outside(const CommonOptions& common);

}  // namespace bvhbench
