// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "device/device.h"

namespace bvhbench {

/// A launch that keeps all of a device busy with a loop of whatever length.
struct FillingLaunch {
    std::size_t work_items;
    std::size_t group;
};

inline FillingLaunch filling_launch(const Device& device)
{
    const std::size_t units = device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    if (device.is_cpu())
        return {4 * units, 1};
    constexpr std::size_t group = 256;
    return {units * 8 * group, group};
}

}  // namespace bvhbench
