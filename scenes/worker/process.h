// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "scenes/worker/child.h"

namespace bvhbench {

/// Spawns `command`, whose first word is a path, with nothing on standard input and standard error
/// thrown away, and waits for it to end; kills it after `time_limit_s`. `extra_environment` is "NAME=value".
/// Throws Unavailable if it cannot be started.
ProcessEnd run_process(const std::vector<std::string>& command, double time_limit_s,
                       const std::string& extra_environment);

}  // namespace bvhbench
