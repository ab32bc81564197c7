// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>

#include "builders/builder.h"
#include "builders/implicit/layout.h"
#include "builders/stages/kernel_form.h"
#include "geometry/aabb.h"

namespace bvhbench {

/// How the launches of Algorithm 1 are divided among work-items.
struct Cut {
    /// groups: one group per subtree; chunks: one work-item per subtree.
    KernelForm form = KernelForm::groups;
    uint group_size = 1;
    uint items = 1;   ///< groups: entry-level nodes that a work-item merges in registers.
    uint levels = 1;  ///< Most levels that one launch builds.
};

/// Returns the cut for a tree of `leaves` leaves with boxes of `box_bytes` bytes on `device`: as `options` asks, else the
/// fastest measured on that kind of device. Throws BadUsage for a group size that the device does not support.
Cut choose_cut(const Device& device, const BuildOptions& options, Meeting meeting, uint leaves,
               std::size_t box_bytes = sizeof(Aabb));

/// Returns the bytes of local memory for a group's boxes: two per work-item, or its entry level if that is larger.
inline std::size_t local_box_bytes(const Cut& cut, std::size_t box_bytes)
{
    return std::size_t{cut.group_size} * std::max(2u, cut.items) * box_bytes;
}

/// Returns `cut` with its group size halved until `fits` is true, or 1 if no size fits. Needed because compilers reserve local
/// memory of their own (such as 16 bytes), and a group may have been given all of it.
Cut cut_that_fits(Cut cut, const std::function<bool(const Cut&)>& fits);

}  // namespace bvhbench
