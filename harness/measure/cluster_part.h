// SPDX-License-Identifier: MIT
//
// What runs of ranks have in common: how a rank gets its triangles, its part on its device, and what the first rank collects.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "cluster/frame.h"
#include "cluster/mpi_ranks.h"
#include "collide/device_lists.h"
#include "harness/base/test_hooks.h"
#include "harness/choice/catalog.h"
#include "harness/measure/cluster.h"
#include "process/watchdog.h"

namespace bvhbench {

/// Returns the scene, all triangles as one object.
Scene whole_scene(const ClusterTask& task, Session& session);

/// Returns a run of consecutive triangles of the scene for this rank, and the scene's name and sizes. The rank makes or reads the
/// run itself if all ranks can, as they cannot if a host lacks the file; else the first rank loads the scene and deals it out.
Share first_share(const ClusterTask& task, Session& session, Ranks& ranks, SceneFacts& facts);

/// Returns the triangles of this rank's part.
Share partitioned_share(Share run, PartitionBy by, Ranks& ranks, std::int64_t& took_ns);

/// Adds what each rank has to the result, by rank; at the first rank only.
void collect_at_first(HostedRanks& ranks, const std::string& device, ClusterRank own,
                      std::vector<ClusterRank>& all);

/// Returns the pairs of all ranks at the first, and none elsewhere.
std::vector<Pair> pairs_at_first(Ranks& ranks, std::vector<Pair> own);

/// Returns the facts of the pairs of all ranks together.
PairFacts facts_of_all(const PairFacts& own, Ranks& ranks);

/// Returns the sum of a number that each rank has.
inline std::uint64_t sum_of_all(std::uint64_t own, Ranks& ranks)
{
    ranks.sum({&own, 1});
    return own;
}

/// Computes the distance that the task asks for, if it does. All ranks must call; each has a part of the scene, in the box `own`.
void resolve_distance(ClusterTask& task, const Aabb& own, Ranks& ranks);

/// Returns what a rank's narrow phase decides.
inline PairTest test_of(const ColliderChoice& collider)
{
    return {collider.narrow, collider.distance, collider.keep_adjacent};
}

/// Calls `work` under the limits of a rank.
template <class Work>
auto watched(const Work& work)
{
    const watchdog::Watch watch;
    return work();
}

/// A partition of the scene, and this rank's part of it on its device.
class ClusterPart {
public:
    ClusterPart(Ranks& ranks, Session& session, const ClusterTask& task)
        : session_(session)
        , builder_(make_builder(task.pipeline.builder, session.programs()))
        , collider_(make_collider(task.pipeline.collider, session.programs()))
        , frame(ranks, session.programs(), session.queue(), *builder_, *collider_,
                test_of(task.pipeline.collider), task.boxes)
    {
        frame.tell_stages([rank = ranks.rank()](std::string_view name) { stop_at(name, rank); });
    }

    /// Takes the triangles, after a trial with the first of them that predicts the memory. Throws Unavailable if that exceeds the
    /// device's.
    void take(Share share)
    {
        own.triangles = share.triangle_count();
        if (own.triangles > tried)
            own.predicted_bytes = predicted(share);
        watched([&] { frame.take(std::move(share)); });
    }

    RankFrame run()
    {
        return watched([&] { return frame.run(); });
    }

private:
    static constexpr std::size_t tried = 1 << 20;  ///< triangles

    std::uint64_t predicted(const Share& share)
    {
        const Device& device = session_.device();
        const std::size_t before = *device.taken;
        watched([&] { frame.take(first_of(share, tried)); });
        const double each = static_cast<double>(*device.taken - before) / tried;
        const std::size_t triangles = share.triangle_count();
        const std::uint64_t pairs = first_pairs_each * triangles;
        const auto all = static_cast<std::uint64_t>(each * static_cast<double>(triangles)) -
                         (pairs - std::min(pairs, most_entries)) * sizeof(Pair);
        *device.most_taken = *device.taken;
        if (all > device.memory_bytes())
            throw Unavailable("its " + std::to_string(triangles) + " triangles would take " +
                              std::to_string(all) + " bytes of " + device.name() + ", which has " +
                              std::to_string(device.memory_bytes()));
        return all;
    }

    Session& session_;
    std::unique_ptr<Builder> builder_;
    std::unique_ptr<Collider> collider_;

public:
    DistributedFrame frame;
    ClusterRank own;  ///< without names
};

/// Runs the frames of the task in `found`, of a scene that moves, each once: triangles stay on their ranks, points move, and the scene is cut
/// anew after a frame in which a rank had too much work. Each frame's answer is compared with that of one device. Fills `found`,
/// at the first rank only. Throws as run_cluster does, and BadUsage for frames that the scene lacks.
void run_cluster_frames(HostedRanks& ranks, Session& session, ClusterFound& found);

}  // namespace bvhbench
