// SPDX-License-Identifier: MIT
#include "collide/oracles/host_collider.h"

#include <algorithm>
#include <utility>

#include "collide/counters.h"
#include "collide/oracles/sweep.h"
#include "geometry/host_memory.h"

namespace bvhbench {

DevicePairs room_for_pairs(const Device& device, std::size_t count)
{
    const auto buffer = [&](std::size_t bytes) {
        return cl::Buffer(device.context, CL_MEM_READ_WRITE, bytes);
    };
    const std::size_t room = std::max<std::size_t>(1, count);
    MemoryShare memory = device.take_memory(room * sizeof(Pair));
    return {.pairs = {buffer(room * sizeof(Pair)), room},
            .counters = {buffer(QUEUES_COUNT * sizeof(uint)), QUEUES_COUNT},
            .memory = std::move(memory)};
}

void copy_pairs(std::span<const Pair> found, DevicePairs& to, const Queue& queue)
{
    std::vector<uint> counters(QUEUES_COUNT, 0u);
    counters[PAIRS_COUNT] = static_cast<uint>(found.size());
    to.counters.upload(queue.cl(), counters);
    to.pairs.upload(queue.cl(), found);
}

DevicePairs HostCollider::device_pairs(Queue& queue)
{
    if (copied_.pairs.size() < std::max<std::size_t>(1, found_.size())) {
        copied_ = {};  // frees the old buffers first
        copied_ = room_for_pairs(device_, found_.size() + found_.size() / 8 + 1);
    }
    queue.on_host("copy", [&] { copy_pairs(found_, copied_, queue); });
    return copied_;
}

namespace {

class Brute final : public HostCollider {
public:
    Brute(const Device& device, const ColliderOptions& options)
        : HostCollider(device, {"brute", "Sweep and prune [Cohen1995]"}, options)
    {}

    void reserve(const Tree*, const Input&) override {}

    void query(const Tree*, const Input& input, Queue& queue) override
    {
        queue.on_host("broad", [&] {
            const PairList found = swept_pairs(
                leaf_boxes(input), WantedPairs(input.faces, options_.keep_adjacent, input.objects,
                                               options_.among, options_.filter));
            require_host_memory("collider brute", found.size() * sizeof(Pair));
            found_.assign(found.pairs().begin(), found.pairs().end());
        });
    }
};

}  // namespace

std::unique_ptr<Collider> make_brute(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Brute>(programs.device(), options);
}

}  // namespace bvhbench
