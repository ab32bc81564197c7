// SPDX-License-Identifier: MIT
#pragma once

#include "cluster/halo.h"
#include "collide/device_collider.h"

namespace bvhbench {

/// Finds the triangles that leave a rank, on the device: `leaving` of cluster/halo.h. In place of pairs of triangles it finds
/// pairs of a triangle and a rank. It queries no tree.
class Leaving final : public DeviceCollider {
public:
    explicit Leaving(Programs& programs);

    /// Uploads the boxes that the next query tests triangles against; at least one. Waits.
    void want(const WantedBoxes& wanted, Queue& queue);

private:
    void compile(const Input& input) override;
    void plan(Arena&) override {}
    bool make_room(std::uint64_t, const std::vector<std::uint64_t>&) override { return true; }
    std::int64_t reads_at_least() const override;
    void enqueue(const Input& input, Queue& queue) override;

    cl::Kernel kernel_;
    std::optional<Arena> wanted_arena_;
    Buffer<Aabb> boxes_;
    Buffer<uint> ranks_;
    uint wanted_count_ = 0;
};

}  // namespace bvhbench
