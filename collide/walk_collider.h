// SPDX-License-Identifier: MIT
//
// What colliders share that find all pairs in one launch, each leaf or group of neighbouring leaves a walk of its
// own: one says which kernel that is.
#pragma once

#include "collide/device_collider.h"

namespace bvhbench {

class WalkCollider : public DeviceCollider {
protected:
    /// Pairs that a work-item of the form for few cores collects before it passes them on: half of its fastest cache.
    static constexpr uint block_pairs = 512;

    WalkCollider(Programs& programs, const ColliderCard& card, const ColliderOptions& options);

    /// Set by `compile`. In the form for few cores it takes a block of pairs a work-item, behind all else.
    cl::Kernel walk_;

private:
    void plan(Arena& arena, const DeviceTree& tree) final;
    void enqueue(const DeviceTree& tree, const Input& input, Queue& queue) final;

    Buffer<Pair> blocks_;
};

}  // namespace bvhbench
