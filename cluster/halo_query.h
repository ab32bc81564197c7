// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "cluster/halo_triangle.h"
#include "collide/device_collider.h"

namespace bvhbench {

/// Finds the pairs of a tree's triangles with triangles of other ranks. In its pairs, halo triangle k has the number of the tree's
/// triangles + k.
class HaloQuery final : public DeviceCollider {
public:
    /// Without `keep_adjacent`, pairs that share a vertex are left out.
    HaloQuery(Programs& programs, bool keep_adjacent);

    /// Takes the tree's triangles, with vertices as numbered in the scene; called before `reserve`. Not needed if adjacent pairs are
    /// kept.
    void own(std::vector<Face> scene_faces) { own_faces_ = std::move(scene_faces); }

    /// Uploads the halo of the next query, at least one triangle. Waits.
    void bring(std::span<const HaloTriangle> halo, Queue& queue);

private:
    void compile(const Input& input) override;
    void plan(Arena&) override {}
    bool make_room(std::uint64_t, const std::vector<std::uint64_t>&) override { return true; }
    void enqueue(const Input& input, Queue& queue) override;

    cl::Kernel kernel_;
    std::vector<Face> own_faces_;
    std::vector<Aabb> halo_boxes_;  ///< as they are uploaded; kept, because new pages take long
    std::vector<Face> halo_faces_;
    std::optional<Arena> halo_arena_;
    Buffer<Aabb> boxes_;
    Buffer<Face> faces_;  ///< the tree's, then the halo's; a single one if adjacent pairs are kept
    uint halo_count_ = 0;
};

}  // namespace bvhbench
