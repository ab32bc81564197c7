// SPDX-License-Identifier: MIT
#include "library/tree.h"

namespace bvhbench::oibvh {

std::string Tree::kernel_text() const
{
    return as_call(*impl_->device, [&] {
        return std::string("#define SORTED_LEAVES ") +
               (impl_->options.sorted_leaves ? "1\n" : "0\n") +
               impl_->device->device.sources.flatten("oibvh/access.clh");
    });
}

}  // namespace bvhbench::oibvh
