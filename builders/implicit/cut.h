// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <functional>

#include "builders/builder.h"
#include "builders/implicit/layout.h"
#include "builders/stages/kernel_form.h"
#include "geometry/aabb.h"

namespace bvhbench {

/// How the launches of Algorithm 1 are cut up on a device.
struct Cut {
    KernelForm form =
        KernelForm::groups;  ///< groups: a group a subtree; chunks: a work-item a subtree
    uint group_size = 1;
    uint items = 1;   ///< groups: entry-level nodes that a work-item merges in registers
    uint levels = 1;  ///< levels a launch builds at most
};

/// The cut for a tree of `leaves` and boxes of so many bytes on `device`: what `options` asks for, else what was measured to be fastest
/// on that kind of device. Throws BadUsage for a group the device does not have.
Cut choose_cut(const Device& device, const BuildOptions& options, Meeting meeting, uint leaves,
               std::size_t box_bytes = sizeof(Aabb));

/// Bytes of local memory that a group keeps boxes in: two a work-item, or its entry level if that is more.
inline std::size_t local_box_bytes(const Cut& cut, std::size_t box_bytes)
{
    return std::size_t{cut.group_size} * std::max(2u, cut.items) * box_bytes;
}

/// `cut`, its groups halved until it `fits`: compilers take local memory of their own, 16 bytes say, and a group may have
/// been given all there is. The smallest there is, if none fits.
Cut cut_that_fits(Cut cut, const std::function<bool(const Cut&)>& fits);

}  // namespace bvhbench
