// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>

#include "baselines/parameters.h"
#include "baselines/radix/hierarchy.h"
#include "builders/stages/kernel_form.h"
#include "geometry/error.h"

namespace bvhbench {

RadixLaunch::RadixLaunch(const Device& device, const BuildOptions& options)
    : group_size(options.group_size)
{
    const auto most = device.cl.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
    if (group_size == 0 && device.is_cpu()) {
        group_size = 1;
        most_items = chunk_count(device);
    } else if (group_size == 0) {
        group_size = std::min<std::size_t>(device.tuned(radix_group_size), std::bit_floor(most));
    } else if (!std::has_single_bit(group_size) || group_size > most) {
        throw BadUsage("a group size is a power of two up to " + std::to_string(most) + " on " +
                       device.name() + ", not " + std::to_string(group_size));
    }
}

void RadixLaunch::operator()(Queue& queue, const cl::Kernel& kernel, uint count,
                             std::int64_t moved_bytes) const
{
    const std::size_t items = most_items != 0 ? std::min<std::size_t>(count, most_items) : count;
    const std::size_t groups = (items + group_size - 1) / group_size;
    queue.launch(kernel, groups * group_size, group_size, moved_bytes);
}

}  // namespace bvhbench
