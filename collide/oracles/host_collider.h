// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "collide/collider.h"

namespace bvhbench {

/// Allocates room for `count` pairs and their counters on the device. Throws Unavailable if memory is too small.
DevicePairs room_for_pairs(const Device& device, std::size_t count);

/// Copies `found` and their number into `to`. Blocks.
void copy_pairs(std::span<const Pair> found, DevicePairs& to, const Queue& queue);

/// Base of colliders on the host: the pairs found, on the host and copied to the device.
class HostCollider : public Collider {
public:
    HostCollider(const Device& device, const ColliderCard& card, const ColliderOptions& options)
        : options_(options), device_(device), card_(card)
    {}

    ColliderCard card() const final { return card_; }
    bool needs_tree() const final { return false; }
    bool is_on_host() const final { return true; }
    std::string refusal(const Tree&) const final { return {}; }
    Footprint reserved() const override { return {}; }
    bool complete(const Queue&) final { return true; }
    QueryCounts counts(const Queue&) const final { return {found_.size(), {}, {}, {}, more_}; }
    std::vector<Pair> pairs(const Queue&) const final { return found_; }
    DevicePairs device_pairs(Queue& queue) final;

protected:
    ColliderOptions options_;
    std::vector<Pair> found_;                                       ///< pairs of the last query
    std::vector<std::pair<std::string_view, std::uint64_t>> more_;  ///< its counters by name

private:
    const Device& device_;
    ColliderCard card_;
    DevicePairs copied_;
};

}  // namespace bvhbench
