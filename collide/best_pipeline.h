// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "device/device.h"

namespace bvhbench {

/// A builder of implicit trees, which sorts its leaves, their order, and a collider, by name.
struct BestPipeline {
    std::string_view builder = "oibvh-multi", collider = "leaf", order = "hilbert30";
};

/// Returns what the library takes where its caller names nothing: the fastest in the measurements of docs/collisions.md. `oibvh-single`
/// takes 0.8 of the time of `oibvh-multi` on an H200, where groups hand over work within a launch. `group` has eight boxes at a time on
/// CPUs, `block` 32 a warp on NVIDIA GPUs. Other devices were not measured; they get `leaf`, in which each leaf traverses the tree by
/// itself, because it needs neither warps nor much local memory.
inline BestPipeline best_pipeline(const Device& device)
{
    const bool hands_over = device.lets_groups_meet() && !device.is_cpu();
    return {hands_over ? "oibvh-single" : "oibvh-multi", device.is_cpu()             ? "group"
                                                         : device.lets_groups_wait() ? "block"
                                                                                     : "leaf"};
}

}  // namespace bvhbench
