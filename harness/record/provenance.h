// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "device/device.h"
#include "harness/record/record.h"

namespace bvhbench {

/// Queries the facts of a device.
DeviceFacts device_facts(const Device& device);

/// Returns the facts of a run that are known at its start. `command` is argv.
RunFacts run_facts(const Device& device, std::vector<std::string> command);

/// Reads /sys and /proc below `root`. `threads` is the number of hardware threads. A build type other than Release adds a
/// warning.
HostConditions host_conditions(int threads, const std::string& build_type,
                               const std::filesystem::path& root = "/");

/// Returns the current time: "2025-11-30T08:15:42Z".
std::string utc_now();

}  // namespace bvhbench
