// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "device/device.h"
#include "harness/record/record.h"

namespace bvhbench {

/// What there is to know about a device, read once.
DeviceFacts device_facts(const Device& device);

/// Everything about a run that is known when it starts.
RunFacts run_facts(const Device& device, std::vector<std::string> command);

/// "2025-11-30T08:15:42Z".
std::string utc_now();

}  // namespace bvhbench
