// SPDX-License-Identifier: MIT
//
// Environment variables with which tests lengthen reported times, to check that comparisons detect it, or stop a rank of a cluster
// at a stage, to kill it there. A run with any of them records them in its result file (`test_hooks`). Such a file is not plotted, and is compared only on request.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "device/queue.h"

namespace bvhbench {

/// Returns the test variables that are set, with their values. Throws BadUsage for a value that cannot be parsed.
std::map<std::string, std::string> test_hooks();

/// Multiplies the stage times of the builder or collider called `name` by its factor in BVHBENCH_SLOW, a comma-separated list
/// such as "oibvh-multi:1.10". Throws BadUsage if the variable cannot be parsed.
void slow_down(std::span<StageTime> stages, std::string_view name);

/// Stops this process by SIGSTOP if BVHBENCH_STOP, as "exchange:1", names this stage and rank of `cluster`. Throws BadUsage
/// if the variable cannot be parsed.
void stop_at(std::string_view stage, unsigned rank);

}  // namespace bvhbench
