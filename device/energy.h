// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <functional>

#include "device/device.h"

namespace bvhbench {

/// Returns a function that reads how many joules the device has taken since a fixed moment: an NVIDIA card by NVML's total
/// energy, a CPU by RAPL's counters of its packages in the folder `powercap`, with all that runs on them. These counters move in steps, up to
/// a tenth of a second apart. Throws Unavailable if there is no counter, or none that may be read; so does the function.
std::function<double()> energy_counter(const Device& device, const std::filesystem::path& powercap);

/// Where Linux has RAPL's counters.
inline constexpr const char* powercap_of_linux = "/sys/class/powercap";

}  // namespace bvhbench
