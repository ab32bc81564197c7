// SPDX-License-Identifier: MIT
#include "harness/measure/cluster_frames.h"

#include <array>
#include <chrono>

#include "cluster/rebalance.h"
#include "geometry/error.h"
#include "harness/measure/cluster_part.h"
#include "harness/measure/cluster_verdict.h"

namespace bvhbench {
namespace {

/// Tells each rank where its points are, from the scene that the first rank has.
class Positions {
public:
    Positions(const Scene& scene, Ranks& ranks) : scene_(scene), ranks_(ranks) {}

    /// Called after each partition.
    void take(const Share& share) { wanted_ = at_first(ranks_, share.vertices); }

    /// Returns the points of this rank's share in a frame.
    std::vector<Point> in(std::size_t frame)
    {
        std::vector<std::vector<Point>> to(ranks_.count());
        if (ranks_.rank() == first_rank)
            for (std::size_t rank = 0; rank < to.size(); ++rank)
                for (const uint vertex : wanted_[rank])
                    to[rank].push_back(scene_.frames[frame][vertex]);
        return std::move(exchanged(ranks_, std::move(to))[first_rank]);
    }

private:
    const Scene& scene_;
    Ranks& ranks_;
    std::vector<std::vector<uint>> wanted_;  ///< vertices of each rank; at the first
};

/// Returns the most work of a rank, divided by the mean.
double imbalance_of(const RankFrame& frame, std::uint64_t triangles, Ranks& ranks)
{
    const std::uint64_t own[] = {triangles + frame.own_pairs + frame.halo_pairs};
    const std::vector<std::uint64_t> all = gathered<std::uint64_t>(ranks, own);
    double sum = 0;
    for (const std::uint64_t work : all)
        sum += static_cast<double>(work);
    return static_cast<double>(std::ranges::max(all)) * static_cast<double>(all.size()) / sum;
}

/// Cuts the scene anew by the pairs of the last frame.
void rebalance(ClusterPart& part, Positions& positions, ClusterFrame& result, Ranks& ranks)
{
    const std::vector<uint> work = work_of(part.frame.share(), part.frame.pairs());
    ranks.wait_for_all();
    const auto start = std::chrono::steady_clock::now();
    Rebalanced next = rebalanced(part.frame.share(), work, ranks);
    ranks.wait_for_all();
    result.rebalance_ns =
        std::chrono::nanoseconds(std::chrono::steady_clock::now() - start).count();
    std::array<std::uint64_t, 1> moved{next.left};
    ranks.sum(moved);
    result.moved_triangles = moved[0];
    positions.take(next.share);
    part.take(std::move(next.share));
}

/// Returns the frames' last verdict if all agree, or what differs in the first that does not.
Check verdict_of_all(const std::vector<ClusterEvidence>& evidence, const Scene& scene,
                     const ClusterResult& result, Session& session)
{
    Check check;
    for (std::size_t k = 0; k < evidence.size(); ++k) {
        const std::size_t frame = result.frames[k].frame;
        check = verdict_of_one_device(evidence[k], scene.frames[frame], scene.faces, session,
                                      result.pipeline);
        if (check.verdict == Check::Verdict::agrees)
            continue;
        check.detail = "frame " + std::to_string(frame) + ": " + check.detail;
        return check;
    }
    return check;
}

}  // namespace

void run_cluster_frames(HostedRanks& ranks, Session& session, const ClusterTask& task,
                        ClusterFound& found)
{
    const bool is_first = ranks.rank() == first_rank;
    ClusterResult& result = found.result;
    std::array<std::uint64_t, 1> there{0};
    if (is_first) {
        found.scene = whole_scene(task, session);
        there[0] = found.scene.frames.size();
    }
    ranks.sum(there);
    const std::size_t end = task.frames.end == 0 ? there[0] : task.frames.end;
    if (end > there[0] || task.frames.first >= end)
        throw BadUsage("--frames asks for " + frame_range_text(task.frames) + ", and " +
                       task.scene + " has " + std::to_string(there[0]) + " frames");
    std::vector<ClusterEvidence> evidence;
    {  // frees the device for the verdict
        ClusterPart part(ranks, session, task);
        Positions positions(found.scene, ranks);
        const std::vector<Point> none;
        Share share =
            partitioned_share(dealt(is_first ? found.scene.frames[task.frames.first] : none,
                                    found.scene.faces, first_rank, ranks),
                              task.partition, ranks, result.partition_ns);
        positions.take(share);
        part.take(std::move(share));
        part.run();  // buffers grow
        std::vector<RankFrame> frames;
        for (std::size_t k = task.frames.first; k < end; ++k) {
            if (k > task.frames.first)
                watched([&] { part.frame.move(positions.in(k)); });
            frames.push_back(part.run());
            ClusterFrame one;
            one.frame = k;
            one.imbalance = imbalance_of(frames.back(), part.own.triangles, ranks);
            ClusterEvidence& of_frame = evidence.emplace_back();
            one.pairs = of_frame.facts = facts_of_all(part.frame.facts(), ranks);
            of_frame.list.emplace(pairs_at_first(ranks, part.frame.pairs()));
            if (has_narrow(task)) {
                const std::vector<Pair> contacts = part.frame.contacts();
                one.contacts = of_frame.contacts = facts_of_all(facts_of(contacts), ranks);
                of_frame.contact_list.emplace(pairs_at_first(ranks, contacts));
            }
            if (k + 1 < end && task.partition == PartitionBy::rcb && one.imbalance > task.rebalance)
                rebalance(part, positions, one, ranks);
            result.frames.push_back(one);
        }
        part.own.frames = std::move(frames);
        part.own.device_bytes = *session.device().most_taken;
        result.pairs = result.frames.back().pairs;
        result.contacts = result.frames.back().contacts;
        tell_first(ranks, session.device().name(), std::move(part.own), result.ranks);
    }
    if (!is_first)
        return;
    result.scene.name = found.scene.name;
    result.scene.triangles = found.scene.triangle_count();
    result.scene.vertices = std::ssize(found.scene.frames.front());
    result.scene.content_hash = found.scene.content_hash;
    result.check = verdict_of_all(evidence, found.scene, result, session);
}

}  // namespace bvhbench
