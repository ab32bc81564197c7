// SPDX-License-Identifier: MIT
#include "collide/host_collider.h"

#include <algorithm>

#include "collide/counters.h"

namespace bvhbench {

DevicePairs HostCollider::device_pairs(Queue& queue)
{
    const auto buffer = [&](std::size_t bytes) {
        return cl::Buffer(device_.context, CL_MEM_READ_WRITE, bytes);
    };
    if (copied_.pairs.size() < std::max<std::size_t>(1, found_.size())) {
        const std::size_t room = found_.size() + found_.size() / 8 + 1;
        copied_.pairs = {buffer(room * sizeof(Pair)), room};
        copied_.counters = {buffer(QUEUES_COUNT * sizeof(uint)), QUEUES_COUNT};
    }
    queue.on_host("copy", [&] {
        std::vector<uint> counters(QUEUES_COUNT, 0u);
        counters[PAIRS_COUNT] = static_cast<uint>(found_.size());
        copied_.counters.upload(queue.cl(), counters);
        copied_.pairs.upload(queue.cl(), found_);
    });
    return copied_;
}

}  // namespace bvhbench
