// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "device/cl.h"

namespace bvhbench {

/// A device as a user may choose it.
struct NamedDevice {
    std::string name;  ///< "Platform/device"
    cl_device_type type = CL_DEVICE_TYPE_DEFAULT;
};

/// Returns the indices of the devices that `words` match, ascending. `words` is an index of up to three digits; "gpu" or "cpu" for
/// devices of that type; or words that the name must all contain, in any case. Without words all GPUs match, otherwise all CPUs,
/// otherwise all devices.
std::vector<std::size_t> matching_devices(std::span<const NamedDevice> devices,
                                          std::string_view words);

/// Returns the first of matching_devices, or the number of devices if none matches.
std::size_t chosen_device(std::span<const NamedDevice> devices, std::string_view words);

/// Returns the indices among device_names() of the devices that device_words(words) match (device/device.h).
std::vector<std::size_t> matching_devices(std::string_view words);

}  // namespace bvhbench
