// SPDX-License-Identifier: MIT
//
// Environment variables with which tests lengthen reported times, to check that comparisons detect it, or stop a rank of a cluster
// at a stage, to kill it there, or an oracle. A run with any of them records them in its result file (`test_hooks`). Such a file is
// not plotted, and is compared only on request.
// Another one shortens the start of a run.
#pragma once

#include <cstddef>
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

/// Returns BVHBENCH_COPY_BYTES, the most bytes of a buffer that the copy rate is measured with; no limit if it is not set. The result
/// file has the size taken (`copy_rate_buffer_bytes`). Throws BadUsage if it is no number from 16 on.
std::size_t most_copied();

/// Returns BVHBENCH_POWERCAP, a folder in the place of that with a processor's counters of joules.
std::string powercap();

/// Stops this process by SIGSTOP if BVHBENCH_STOP, as "exchange:1", names this stage and rank of `cluster`. Throws BadUsage
/// if the variable cannot be parsed.
void stop_at(std::string_view stage, unsigned rank);

/// The same of this thread alone, which waits for ever, and of rank 0.
void stop_thread_at(std::string_view stage);

}  // namespace bvhbench
