// SPDX-License-Identifier: MIT
//
// Mesa's llvmpipe (22.3, as OpenCL through Rusticl) gives a work-item 65,535 steps in all its loops together and then ends
// each loop after one step more. Lanes of a group that no work-item has use the steps up too: what they load is 0, and a loop
// that waits for another value runs on in them. OpenCL C allows neither.
#pragma once

#include <cstddef>

#include "device/device.h"

namespace bvhbench {

/// Where loops end early, kernels for few cores still build scenes of up to this size: a work-item has few enough steps.
constexpr std::size_t most_triangles_in_short_loops = 16384;

/// Whether a loop of 100,000 steps ends early on the device: a probe, which compiles and runs a kernel.
bool ends_loops_early(const Device& device);

}  // namespace bvhbench
