// SPDX-License-Identifier: MIT
//
// Implementation of DistributedTree: this rank, its device, and its part of the scene.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "cluster/agreeing_ranks.h"
#include "cluster/comm_ranks.h"
#include "cluster/frame.h"
#include "cluster/point_routes.h"
#include "library/device.h"
#include "library_cluster/include/bvhbench/oibvh_cluster.h"

namespace bvhbench::oibvh {

struct DistributedTree::Impl {
    Impl(MPI_Comm comm, cl_command_queue queue, const ClusterOptions& asked);

    /// A builder and a collider, and the frames over them.
    struct Part {
        explicit Part(Impl& impl);

        std::unique_ptr<Builder> builder;
        std::unique_ptr<Collider> collider;
        DistributedFrame frame;
    };

    /// Runs `work`, which changes nothing, together with all ranks.
    void check(const std::function<void()>& work) { together_or(work, false); }

    /// Runs `work`, which changes the scene, together with all ranks. If it fails, there is no scene.
    void change(const std::function<void()>& work) { together_or(work, true); }

    /// Divides the scene, of which each rank passes some triangles, and gets the points of its part from those that ranks give: those
    /// of `vertices`, as numbered in the scene.
    void distribute(Share own, std::vector<uint> vertices, std::span<const bvhbench::Point> points);

    /// Makes frames over the triangles of this rank.
    void take(Share share);

    // Throw BadUsage, whose message begins with `what`.
    void require_scene(const char* what) const;
    void require_frame(const char* what) const;
    void require_contacts() const;

    std::vector<Pair> pairs(bool are_contacts);

    const std::unique_ptr<HostedRanks> processes;
    AgreeingRanks ranks;
    ClusterOptions options;
    std::optional<Device::Impl> device;  ///< empty only while it is made
    std::unique_ptr<Part> part;          ///< null if there is no scene
    std::vector<uint>
        given;  ///< vertices, as numbered in the scene, of the points that the caller passed
    PointRoutes routes;
    bool has_frame = false;  ///< whether `part` has the pairs of a frame

private:
    void together_or(const std::function<void()>& work, bool drops);
};

}  // namespace bvhbench::oibvh
