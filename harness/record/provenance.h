// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "device/device.h"
#include "harness/base/json_keys.h"
#include "harness/choice/sampling.h"

namespace bvhbench {

/// Returns what the program depends on or reports of a device: `kind` is cpu, gpu or other.
Json device_facts(const Device& device);

/// Returns what a result file has under `run` (results/schema/result-1.schema.json) when the run starts: machine, program and
/// settings. `command` is argv, `costs` those in the counters sah_cost and epo.
Json run_facts(const Device& device, std::vector<std::string> command, const NodeCosts& costs = {});

/// Returns what a result file has under `conditions`: the settings of the host that distort times, as far as they are known, and
/// one sentence in `warnings` for each that does, or for a build type other than Release. Reads /sys and /proc below `root`.
Json host_conditions(const std::string& build_type, const std::filesystem::path& root = "/");

/// Puts the mean number of other processes that wanted to run between samples into `conditions`, and a warning if they are more than
/// a quarter of the hardware threads.
void put_other_processes(Json& conditions, double mean,
                         unsigned threads = std::thread::hardware_concurrency());

/// Returns the current time: "2025-11-30T08:15:42Z".
std::string utc_now();

}  // namespace bvhbench
