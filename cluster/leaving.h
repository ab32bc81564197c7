// SPDX-License-Identifier: MIT
#pragma once

#include "cluster/halo.h"
#include "cluster/halo_triangle.h"
#include "cluster/share.h"
#include "collide/device_collider.h"

namespace bvhbench {

/// Finds the triangles that leave a rank, on the device: `leaving` of cluster/halo.h. In place of pairs of triangles it finds
/// pairs of a triangle and a rank, and packs the triangle of each. It queries no tree.
class Leaving final : public DeviceCollider {
public:
    /// Without `with_vertices`, the triangles that are packed do not have the scene's vertices.
    Leaving(Programs& programs, bool with_vertices);

    /// Takes the triangles of the next queries, before `reserve`; `share` must stay as long as they run.
    void own(const Share& share) { share_ = &share; }

    /// Uploads the boxes that the next query tests triangles against; at least one. Waits.
    void want(const WantedBoxes& wanted, Queue& queue);

    /// Reads the triangle of each of the `count` pairs that the last query found, once it is complete. Blocks.
    void read_packed(std::vector<HaloTriangle>& packed, std::size_t count,
                     const Queue& queue) const;

private:
    void compile(const Input& input) override;
    void plan(Arena& arena) override;
    void fill(const cl::CommandQueue& queue) override;
    bool make_room(std::uint64_t, const std::vector<std::uint64_t>&) override { return true; }
    std::int64_t reads_at_least() const override;
    void enqueue(const Input& input, Queue& queue) override;

    bool with_vertices_;
    const Share* share_ = nullptr;
    cl::Kernel kernel_, pack_;
    std::optional<Arena> wanted_arena_;
    Buffer<Aabb> boxes_;
    Buffer<WantedBoxes::OfRank> ranks_;
    uint rank_count_ = 0;
    Buffer<uint> ids_;
    Buffer<uint> vertices_;  ///< a single one if they are not packed
    Buffer<HaloTriangle> packed_;
};

}  // namespace bvhbench
