// SPDX-License-Identifier: MIT
#include "harness/measure/cluster.h"

#include <array>
#include <chrono>
#include <optional>

#include "cluster/lone_rank.h"
#include "cluster/share.h"
#include "device/device_choice.h"
#include "geometry/error.h"
#include "geometry/host_memory.h"
#include "harness/measure/cluster_verdict.h"
#include "harness/session/watchdog.h"
#include "scenes/face_order.h"

namespace bvhbench {
namespace {

constexpr std::size_t sample_size = 10'000;  ///< triangles that are held against all others

constexpr uint first_rank = 0;  ///< reads the scene and gathers what is found

Scene whole_scene(const ClusterTask& task, Session& session)
{
    return with_objects(load_scene(task.scene, session.scenes()), ObjectsBy::one);
}

/// Returns a run of consecutive triangles of the scene for this rank, and the scene's name and sizes. The rank makes or reads the
/// run itself if all ranks can, as they cannot if a host lacks the file; else the first rank loads the scene and deals it out.
Share first_share(const ClusterTask& task, Session& session, Ranks& ranks, SceneFacts& facts)
{
    facts.name = scene_name(task.scene);
    std::optional<ScenePart> part = load_part(task.scene, ranks.rank(), ranks.count());
    std::array<std::uint64_t, 1> ranks_with_parts{part ? 1u : 0u};
    ranks.sum(ranks_with_parts);
    if (ranks_with_parts[0] == ranks.count()) {
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

/// Returns the triangles of this rank's part.
Share partitioned_share(Share run, PartitionBy by, Ranks& ranks, std::int64_t& took_ns)
{
    ranks.wait_for_all();
    const auto start = std::chrono::steady_clock::now();
    std::vector<Point> centres = box_centres(run);
    const std::vector<uint> to = partitioned({centres, run.ids}, by, ranks.count(), ranks);
    centres = {};
    Share share = moved(std::move(run), to, ranks);
    ranks.wait_for_all();
    took_ns = std::chrono::nanoseconds(std::chrono::steady_clock::now() - start).count();
    return share;
}

/// Sends values of every rank to the first, which gets them by rank; the others get none.
template <class T>
std::vector<std::vector<T>> at_first(Ranks& ranks, std::vector<T> own)
{
    std::vector<std::vector<T>> to(ranks.count());
    to[first_rank] = std::move(own);
    return exchanged(ranks, std::move(to));
}

std::vector<char> characters(const std::string& text) { return {text.begin(), text.end()}; }

/// Adds what each rank has to the result, by rank; at the first rank only.
void tell_first(HostedRanks& ranks, const std::string& device, ClusterRank own,
                std::vector<ClusterRank>& all)
{
    const std::uint64_t numbers[] = {own.triangles, own.predicted_bytes, own.device_bytes,
                                     host_memory_facts().peak};
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

/// Returns the pairs of all ranks at the first, and none elsewhere.
std::vector<Pair> pairs_at_first(Ranks& ranks, std::vector<Pair> own)
{
    std::vector<Pair> all;
    for (std::vector<Pair>& of_rank : at_first(ranks, std::move(own))) {
        all.insert(all.end(), of_rank.begin(), of_rank.end());
        of_rank = {};
    }
    return all;
}

/// Returns the facts of the pairs of all ranks together.
PairFacts facts_of_all(const PairFacts& own, Ranks& ranks)
{
    std::array<std::uint64_t, 3> sums{own.count, own.low, own.high};
    ranks.sum(sums);
    return {sums[0], sums[1], sums[2]};
}

/// Calls `work` under the limits of a rank.
template <class Work>
auto watched(const Work& work)
{
    const watchdog::Watch watch;
    return work();
}

/// A partition of the scene, and this rank's part of it on its device.
class Part {
public:
    Part(HostedRanks& ranks, Session& session, const ClusterTask& task)
        : session_(session)
        , builder_(make_builder(task.pipeline.builder, session.programs()))
        , collider_(make_collider(task.pipeline.collider, session.programs()))
        , frame(ranks, session.programs(), session.queue(), *builder_, *collider_,
                task.pipeline.collider.keep_adjacent, task.pipeline.collider.narrow, task.boxes)
    {}

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
        const auto all =
            static_cast<std::uint64_t>(each * static_cast<double>(share.triangle_count()));
        *device.most_taken = *device.taken;
        if (all > device.memory_bytes())
            throw Unavailable("its " + std::to_string(share.triangle_count()) +
                              " triangles would take " + std::to_string(all) + " bytes of " +
                              device.name() + ", which has " +
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

bool has_narrow(const ClusterTask& task) { return task.pipeline.collider.narrow != "none"; }

PairFacts contacts_of_all(const Part& part, Ranks& ranks)
{
    return facts_of_all(facts_of(part.frame.contacts()), ranks);
}

/// Returns whether one device, by what the ranks' took, can hold the whole scene.
bool fits_one_device(const Part& part, const PairFacts& pairs, std::uint64_t triangles,
                     const Device& device, Ranks& ranks)
{
    std::uint64_t each[] = {part.own.triangles == 0 ? 0
                                                    : part.own.device_bytes / part.own.triangles};
    const std::vector<std::uint64_t> all = gathered<std::uint64_t>(ranks, each);
    return pairs.count < std::uint64_t{1} << 32 &&
           std::ranges::max(all) * triangles < device.memory_bytes();
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
            " need a device "
            "each, and " +
            (devices.size() == 1 ? "one matches" : std::to_string(devices.size()) + " match") +
            "; with --share-devices they share, which is for tests and gives no times");
    return std::to_string(devices[ranks.local_rank() % devices.size()]);
}

ClusterFound run_cluster(HostedRanks& ranks, Session& session, const ClusterTask& task)
{
    const bool is_first = ranks.rank() == first_rank;
    ClusterFound found;
    ClusterResult& result = found.result;
    result.partition = task.partition;
    result.pipeline = task.pipeline;
    result.boxes = task.boxes;
    result.shares_devices = task.share_devices;
    ClusterEvidence evidence;
    bool by_one_device = task.check == ClusterCheck::one_device;
    {  // frees the device for the verdict
        Part part(ranks, session, task);
        part.take(partitioned_share(first_share(task, session, ranks, result.scene), task.partition,
                                    ranks, result.partition_ns));
        part.run();  // buffers grow
        for (int k = 0; k < task.samples; ++k)
            part.own.frames.push_back(part.run());
        part.own.device_bytes = *session.device().most_taken;
        result.pairs = evidence.facts = facts_of_all(part.frame.facts(), ranks);
        if (task.wants_pairs || result.pairs.count <= task.most_gathered)
            evidence.list.emplace(pairs_at_first(ranks, part.frame.pairs()));
        if (has_narrow(task))
            result.contacts = evidence.contacts = contacts_of_all(part, ranks);
        if (has_narrow(task) &&
            (task.wants_contacts || evidence.contacts->count <= task.most_gathered))
            evidence.contact_list.emplace(pairs_at_first(ranks, part.frame.contacts()));
        std::array<std::uint64_t, 1> triangles{part.own.triangles};
        ranks.sum(triangles);
        if (task.check == ClusterCheck::automatic)
            by_one_device =
                fits_one_device(part, result.pairs, triangles[0], session.device(), ranks);
        if (!by_one_device) {
            const TriangleSample sample(triangles[0], sample_size);
            evidence.of_sample = pairs_at_first(ranks, part.frame.pairs_of(sample));
            evidence.right_of_sample = pairs_at_first(ranks, part.frame.right_pairs_of(sample));
        }
        tell_first(ranks, session.device().name(), std::move(part.own), result.ranks);
    }
    if (!by_one_device) {
        const auto other =
            task.partition == PartitionBy::rcb ? PartitionBy::curve : PartitionBy::rcb;
        Part part(ranks, session, task);
        std::int64_t took_ns = 0;
        SceneFacts facts;
        part.take(
            partitioned_share(first_share(task, session, ranks, facts), other, ranks, took_ns));
        part.run();
        evidence.other_partition = facts_of_all(part.frame.facts(), ranks);
        if (has_narrow(task))
            evidence.other_contacts = contacts_of_all(part, ranks);
    }
    if (!is_first)
        return found;
    if (by_one_device || task.wants_pairs || task.wants_contacts) {
        found.scene = whole_scene(task, session);
        result.scene.content_hash = found.scene.content_hash;
    }
    result.check = by_one_device
                       ? verdict_of_one_device(evidence, found.scene, session, task.pipeline)
                       : verdict_of_partitions(evidence);
    if (evidence.list)
        found.pairs = *std::move(evidence.list);
    if (evidence.contact_list)
        found.contacts = *std::move(evidence.contact_list);
    return found;
}

Simulation simulate_cluster(Session& session, const ClusterTask& task, uint ranks)
{
    Simulation simulation;
    simulation.partition = task.partition;
    simulation.builder = task.pipeline.builder;
    simulation.boxes = task.boxes;
    LoneRank lone;
    const Share whole = first_share(task, session, lone, simulation.scene);
    const auto builder = make_builder(task.pipeline.builder, session.programs());
    simulation.ranks = simulated(whole, task.partition, ranks, task.boxes, session.programs(),
                                 session.queue(), *builder);
    return simulation;
}

}  // namespace bvhbench
