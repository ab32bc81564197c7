// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "device/device.h"
#include "harness/record.h"

namespace bvhbench {

/// What there is to know about a device, read once.
DeviceFacts device_facts(const Device& device);

/// Everything about a run that is known when it starts.
RunFacts run_facts(const Device& device, std::vector<std::string> command);

/// Put down what memory the process was given, foresaw and took up to now. What is there of an earlier process stays where
/// it is more.
void note_memory(RunFacts& run);

/// "2025-11-30T08:15:42Z".
std::string utc_now();

}  // namespace bvhbench
