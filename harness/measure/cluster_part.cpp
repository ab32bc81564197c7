// SPDX-License-Identifier: MIT
#include "harness/measure/cluster_part.h"

#include <array>
#include <optional>

#include "cluster/rebalance.h"
#include "geometry/host_memory.h"
#include "harness/choice/distance_words.h"
#include "harness/measure/engine.h"
#include "scenes/catalog.h"
#include "scenes/face_order.h"

namespace bvhbench {
Scene whole_scene(const ClusterTask& task, Session& session)
{
    return with_objects(load_scene(task.scene, session.scenes()), ObjectsBy::one);
}

Share first_share(const ClusterTask& task, Session& session, Ranks& ranks, SceneFacts& facts)
{
    facts.name = scene_name(task.scene);
    std::optional<ScenePart> part = load_part(task.scene, ranks.rank(), ranks.count());
    if (sum_of_all(part ? 1 : 0, ranks) == ranks.count()) {
        facts.triangles = static_cast<std::int64_t>(part->triangles);
        facts.vertices = static_cast<std::int64_t>(part->mesh.mesh_points);
        return share_of(std::move(part->mesh), part->run.first);
    }
    part.reset();
    if (ranks.rank() != first_rank)
        return dealt({}, {}, first_rank, ranks);
    const Scene scene = whole_scene(task, session);
    facts.triangles = scene.triangle_count();
    facts.vertices = std::ssize(scene.frames.front());
    return dealt(scene.frames.front(), scene.faces, first_rank, ranks);
}

void resolve_distance(ClusterTask& task, const Aabb& own, Ranks& ranks)
{
    float ends[] = {own.min_x, own.min_y, own.min_z, -own.max_x, -own.max_y, -own.max_z};
    ranks.least(ends);
    task.pipeline.collider.distance = distance_of(
        task.pipeline.collider.within, {ends[0], ends[1], ends[2], -ends[3], -ends[4], -ends[5]});
}

Share partitioned_share(Share run, PartitionBy by, Ranks& ranks, std::int64_t& took_ns)
{
    ranks.wait_for_all();
    stop_at("partition", ranks.rank());
    Share share;
    took_ns = host_ns([&] {
        share = cut(std::move(run), by, {}, ranks).share;
        ranks.wait_for_all();
    });
    return share;
}

void collect_at_first(HostedRanks& ranks, const std::string& device, ClusterRank own,
                      std::vector<ClusterRank>& all)
{
    const std::uint64_t numbers[] = {own.triangles, own.predicted_bytes, own.device_bytes,
                                     host_memory_facts().peak};
    const auto characters = [](const std::string& text) {
        return std::vector<char>(text.begin(), text.end());
    };
    const auto hosts = at_first(ranks, characters(ranks.host()));
    const auto devices = at_first(ranks, characters(device));
    const auto of_ranks = at_first(ranks, std::vector(std::begin(numbers), std::end(numbers)));
    std::vector<std::vector<RankFrame>> frames = at_first(ranks, std::move(own.frames));
    for (uint rank = 0; ranks.rank() == first_rank && rank < ranks.count(); ++rank) {
        const std::vector<std::uint64_t>& of = of_ranks[rank];
        all.push_back({{hosts[rank].begin(), hosts[rank].end()},
                       {devices[rank].begin(), devices[rank].end()},
                       of[0],
                       of[1],
                       of[2],
                       of[3],
                       std::move(frames[rank])});
    }
}

std::vector<Pair> pairs_at_first(Ranks& ranks, std::vector<Pair> own)
{
    stop_at("gathering", ranks.rank());
    return all_at_first(ranks, std::move(own));
}

PairFacts facts_of_all(const PairFacts& own, Ranks& ranks)
{
    std::array<std::uint64_t, 3> sums{own.count, own.low, own.high};
    ranks.sum(sums);
    return {sums[0], sums[1], sums[2]};
}

}  // namespace bvhbench
