// SPDX-License-Identifier: MIT
#include "harness/measure/cluster_part.h"

#include <numeric>

#include "cluster/point_routes.h"
#include "cluster/rebalance.h"
#include "geometry/error.h"
#include "harness/measure/cluster_verdict.h"
#include "harness/measure/engine.h"
#include "harness/measure/frames.h"

namespace bvhbench {
namespace {

/// Cuts the scene anew by the pairs of the last frame.
void rebalance(ClusterPart& part, ClusterFrame& result, Ranks& ranks)
{
    const std::vector<uint> work = work_of(part.frame.share(), part.frame.pairs());
    ranks.wait_for_all();
    Cut next;
    result.rebalance_ns = host_ns([&] {
        next = cut(part.frame.share(), PartitionBy::rcb, work, ranks);
        ranks.wait_for_all();
    });
    result.moved_triangles = sum_of_all(next.left, ranks);
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
                                      result.task.pipeline);
        if (check.verdict == Check::Verdict::agrees)
            continue;
        check.detail = "frame " + std::to_string(frame) + ": " + check.detail;
        return check;
    }
    return check;
}

}  // namespace

void run_cluster_frames(HostedRanks& ranks, Session& session, ClusterFound& found)
{
    const bool is_first = ranks.rank() == first_rank;
    ClusterResult& result = found.result;
    const ClusterTask& task = result.task;
    Aabb around = empty_box();
    if (is_first) {
        found.scene = whole_scene(task, session);
        around = box_around(found.scene.frames.front(), found.scene.faces);
    }
    resolve_distance(result.task, around, ranks);
    const std::uint64_t there = sum_of_all(found.scene.frames.size(), ranks);
    const std::size_t end = task.frames.end == 0 ? there : task.frames.end;
    if (end > there || task.frames.first >= end)
        throw BadUsage("--frames asks for " + frame_range_text(task.frames) + ", and " +
                       task.scene + " has " + std::to_string(there) + " frames");
    std::vector<ClusterEvidence> evidence;
    {  // frees the device for the verdict
        ClusterPart part(ranks, session, task);
        std::vector<uint> vertices;  // the first rank has the points of all
        if (is_first) {
            vertices.resize(found.scene.frames.front().size());
            std::iota(vertices.begin(), vertices.end(), 0u);
        }
        const auto points_in = [&](std::size_t frame) {
            return is_first ? std::span<const Point>(found.scene.frames[frame])
                            : std::span<const Point>();
        };
        part.take(partitioned_share(
            dealt(points_in(task.frames.first), found.scene.faces, first_rank, ranks),
            task.partition, ranks, result.partition_ns));
        PointRoutes routes(vertices, part.frame.share(), ranks);
        part.run();  // buffers grow
        std::vector<RankFrame> frames;
        for (std::size_t k = task.frames.first; k < end; ++k) {
            if (k > task.frames.first)
                watched([&] { part.frame.move(routes.sent(points_in(k), ranks)); });
            frames.push_back(part.run());
            ClusterFrame one{.frame = k};
            one.imbalance = imbalance_of(
                part.own.triangles + frames.back().own_pairs + frames.back().halo_pairs, ranks);
            ClusterEvidence& of_frame = evidence.emplace_back();
            one.pairs = of_frame.facts = facts_of_all(part.frame.facts(), ranks);
            of_frame.list.emplace(pairs_at_first(ranks, part.frame.pairs()));
            if (task.has_narrow()) {
                const std::vector<Pair> contacts = part.frame.contacts();
                one.contacts = of_frame.contacts = facts_of_all(facts_of(contacts), ranks);
                of_frame.contact_list.emplace(pairs_at_first(ranks, contacts));
            }
            if (k + 1 < end && task.partition == PartitionBy::rcb &&
                one.imbalance > task.rebalance) {
                rebalance(part, one, ranks);
                routes = PointRoutes(vertices, part.frame.share(), ranks);
            }
            result.frames.push_back(one);
        }
        part.own.frames = std::move(frames);
        part.own.device_bytes = *session.device().most_taken;
        result.pairs = result.frames.back().pairs;
        result.contacts = result.frames.back().contacts;
        collect_at_first(ranks, session.device().name(), std::move(part.own), result.ranks);
    }
    if (!is_first)
        return;
    result.scene = facts_of(found.scene, found.scene.name, task.frames.first);
    result.check = verdict_of_all(evidence, found.scene, result, session);
}

}  // namespace bvhbench
