// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "device/cl.h"

namespace bvhbench {

/// A device as a user may choose it.
struct NamedDevice {
    std::string name;  ///< "Platform/device"
    cl_device_type type = CL_DEVICE_TYPE_DEFAULT;
};

/// Returns the index of the device that `words` selects, or the number of devices if none matches. `words` is an index of up to
/// three digits; "gpu" or "cpu" for the first device of that type; or words that the name must all contain, in any case. Without
/// words the first GPU is selected, otherwise the first CPU, otherwise the first device.
std::size_t chosen_device(std::span<const NamedDevice> devices, std::string_view words);

}  // namespace bvhbench
