// SPDX-License-Identifier: MIT
#include "harness/measure/cluster.h"

#include <algorithm>

#include "cluster/lone_rank.h"
#include "cluster/share.h"
#include "device/device_choice.h"
#include "geometry/error.h"
#include "harness/base/test_hooks.h"
#include "harness/measure/cluster_part.h"
#include "harness/measure/cluster_verdict.h"

namespace bvhbench {
namespace {

constexpr std::size_t judged_triangles = 10'000;  ///< triangles that are compared with all others

/// Returns whether one device, by what the ranks' took, can hold the whole scene.
bool fits_one_device(const ClusterPart& part, const PairFacts& pairs, std::uint64_t triangles,
                     const Device& device, Ranks& ranks)
{
    std::uint64_t each[] = {part.own.triangles == 0 ? 0
                                                    : part.own.device_bytes / part.own.triangles};
    const std::vector<std::uint64_t> all = gathered<std::uint64_t>(ranks, each);
    return pairs.count < std::uint64_t{1} << 32 &&
           std::ranges::max(all) * triangles < device.memory_bytes();
}

/// Returns the median time of a frame of a part alone.
std::int64_t part_ns(Share share, const ClusterTask& task, Session& session)
{
    LoneRank lone;
    ClusterPart part(lone, session, task);
    part.take(std::move(share));
    part.run();  // buffers grow
    std::vector<std::int64_t> samples;
    for (int k = 0; k < task.samples; ++k)
        samples.push_back(part.run().whole_ns);
    std::ranges::sort(samples);
    return samples[samples.size() / 2];
}

}  // namespace

std::string device_of_rank(const std::string& words, const HostedRanks& ranks, bool share_devices)
{
    const std::vector<std::size_t> devices = matching_devices(words);
    if (devices.empty())
        return words;  // opening it says what there is
    if (!share_devices && devices.size() < ranks.local_count())
        throw Unavailable(
            std::to_string(ranks.local_count()) + " ranks on " + ranks.host() +
            " need a device each, and " +
            (devices.size() == 1 ? "one matches" : std::to_string(devices.size()) + " match") +
            "; with --share-devices they share, which is for tests and gives no times");
    return std::to_string(devices[ranks.local_rank() % devices.size()]);
}

ClusterFound run_cluster(HostedRanks& ranks, Session& session, const ClusterTask& asked)
{
    ClusterFound found;
    ClusterResult& result = found.result;
    const ClusterTask& task = result.task = asked;
    result.task.ranks = ranks.count();
    if (task.moves()) {
        run_cluster_frames(ranks, session, found);
        return found;
    }
    ClusterEvidence evidence;
    bool by_one_device = task.check == ClusterCheck::one_device;
    {  // frees the device for the verdict
        Share share = partitioned_share(first_share(task, session, ranks, result.scene),
                                        task.partition, ranks, result.partition_ns);
        resolve_distance(result.task, box_around(share.points, share.faces), ranks);
        ClusterPart part(ranks, session, task);
        part.take(std::move(share));
        part.run();  // buffers grow
        for (int k = 0; k < task.samples; ++k)
            part.own.frames.push_back(part.run());
        part.own.device_bytes = *session.device().most_taken;
        result.pairs = evidence.facts = facts_of_all(part.frame.facts(), ranks);
        if (task.wants_pairs || result.pairs.count <= task.most_gathered)
            evidence.list.emplace(pairs_at_first(ranks, part.frame.pairs()));
        if (task.has_narrow())
            result.contacts = evidence.contacts =
                facts_of_all(facts_of(part.frame.contacts()), ranks);
        if (task.has_narrow() &&
            (task.wants_contacts || evidence.contacts->count <= task.most_gathered))
            evidence.contact_list.emplace(pairs_at_first(ranks, part.frame.contacts()));
        const std::uint64_t triangles = sum_of_all(part.own.triangles, ranks);
        if (task.check == ClusterCheck::automatic)
            by_one_device = fits_one_device(part, result.pairs, triangles, session.device(), ranks);
        if (!by_one_device) {
            const TriangleSample sample(triangles, judged_triangles);
            evidence.of_sample = pairs_at_first(ranks, part.frame.pairs_of(sample));
            evidence.right_of_sample = pairs_at_first(ranks, part.frame.right_pairs_of(sample));
        }
        collect_at_first(ranks, session.device().name(), std::move(part.own), result.ranks);
    }
    if (!by_one_device) {
        const auto other =
            task.partition == PartitionBy::rcb ? PartitionBy::curve : PartitionBy::rcb;
        ClusterPart part(ranks, session, task);
        std::int64_t took_ns = 0;
        SceneFacts facts;
        part.take(
            partitioned_share(first_share(task, session, ranks, facts), other, ranks, took_ns));
        part.run();
        evidence.other_partition = facts_of_all(part.frame.facts(), ranks);
        if (task.has_narrow())
            evidence.other_contacts = facts_of_all(facts_of(part.frame.contacts()), ranks);
    }
    if (ranks.rank() != first_rank)
        return found;
    stop_at("verdict", first_rank);
    if (by_one_device || task.wants_pairs || task.wants_contacts) {
        found.scene = whole_scene(task, session);
        result.scene.content_hash = found.scene.content_hash;
    }
    result.check = by_one_device ? verdict_of_one_device(evidence, found.scene.frames.front(),
                                                         found.scene.faces, session, task.pipeline)
                                 : verdict_of_partitions(evidence);
    if (evidence.list)
        found.pairs = *std::move(evidence.list);
    if (evidence.contact_list)
        found.contacts = *std::move(evidence.contact_list);
    return found;
}

Simulation simulate_cluster(Session& session, const ClusterTask& task)
{
    Simulation simulation{.task = task};
    LoneRank lone;
    std::vector<Share> shares = shares_of(first_share(task, session, lone, simulation.scene),
                                          task.partition, task.simulates);
    simulation.ranks = simulated(shares, task.boxes, session.programs(), session.queue(),
                                 *make_builder(task.pipeline.builder, session.programs()));
    const auto largest = std::ranges::max_element(shares, {}, &Share::triangle_count);
    simulation.part_ns = part_ns(std::move(*largest), task, session);
    return simulation;
}

}  // namespace bvhbench
