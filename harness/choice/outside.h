// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "harness/base/common_options.h"

namespace bvhbench {

/// Starts each plug-in of --plugin, BVHBENCH_PLUGINS and --program, and adds what it says it has to the catalogs. Returns a sentence for
/// each that does not start or has a name that is taken; its cells fail with that sentence.
std::vector<std::string> start_outside(const CommonOptions& common);

/// Throws BadUsage if anything from outside is given to `command`, which runs this program's own builders and colliders only: it would
/// take no part, and the exit code would say nothing of it.
void refuse_outside(const CommonOptions& common, const std::string& command);

}  // namespace bvhbench
