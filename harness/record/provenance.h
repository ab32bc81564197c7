// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "device/device.h"
#include "harness/record/record.h"

namespace bvhbench {

/// What there is to know about a device, read once.
DeviceFacts device_facts(const Device& device);

/// Everything about a run that is known when it starts.
RunFacts run_facts(const Device& device, std::vector<std::string> command);

/// Read from /sys and /proc below `root`. `threads` is how many the host runs at once; a build of another type than Release
/// is one more thing to warn of.
HostConditions host_conditions(int threads, const std::string& build_type,
                               const std::filesystem::path& root = "/");

/// "2025-11-30T08:15:42Z".
std::string utc_now();

}  // namespace bvhbench
