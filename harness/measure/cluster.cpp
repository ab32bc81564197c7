// SPDX-License-Identifier: MIT
#include "harness/measure/cluster.h"

#include <array>
#include <chrono>
#include <optional>

#include "cluster/share.h"
#include "device/device_choice.h"
#include "geometry/error.h"
#include "harness/session/watchdog.h"
#include "scenes/face_order.h"

namespace bvhbench {
namespace {

constexpr uint first_rank = 0;  ///< reads the scene and gathers what is found

Scene whole_scene(const ClusterTask& task, Session& session)
{
    return with_objects(load_scene(task.scene, session.scenes()), ObjectsBy::one);
}

/// Returns a run of consecutive triangles of the scene for this rank, and the scene's name and sizes. The rank makes the run itself,
/// or the first rank loads the scene and deals it out.
Share first_share(const ClusterTask& task, Session& session, Ranks& ranks, SceneFacts& facts)
{
    facts.name = scene_name(task.scene);
    if (std::optional<ScenePart> part = load_part(task.scene, ranks.rank(), ranks.count())) {
        facts.triangles = static_cast<std::int64_t>(part->triangles);
        facts.vertices = static_cast<std::int64_t>(part->mesh.mesh_points);
        return share_of(std::move(part->mesh), part->run.first);
    }
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

std::vector<ClusterRank> ranks_at_first(HostedRanks& ranks, const Session& session,
                                        std::uint64_t triangles, std::vector<RankFrame> frames)
{
    const auto hosts = at_first(ranks, characters(ranks.host()));
    const auto devices = at_first(ranks, characters(session.device().name()));
    const auto counts = at_first(ranks, std::vector{triangles});
    std::vector<std::vector<RankFrame>> all = at_first(ranks, std::move(frames));
    std::vector<ClusterRank> result;
    for (uint rank = 0; ranks.rank() == first_rank && rank < ranks.count(); ++rank)
        result.push_back({{hosts[rank].begin(), hosts[rank].end()},
                          {devices[rank].begin(), devices[rank].end()},
                          counts[rank].front(),
                          std::move(all[rank])});
    return result;
}

/// Returns the pairs that this rank's device finds in the whole scene.
std::vector<Pair> pairs_of_one_device(Session& session, const PipelineChoice& choice,
                                      const Scene& scene)
{
    const Input input =
        upload(session.device(), session.queue(), scene.frames.front(), scene.faces);
    const auto builder = make_builder(choice.builder, session.programs());
    const auto collider = make_collider(choice.collider, session.programs());
    builder->reserve(input.triangle_count());
    const Tree& tree = builder->build(input, session.queue());
    collider->reserve(&tree, input);
    find_pairs(*collider, &tree, input, session.queue());
    session.queue().finish();
    return collider->pairs(session.queue());
}

/// Returns the facts of the pairs of all ranks together.
PairFacts facts_of_all(std::span<const Pair> own, Ranks& ranks)
{
    const PairFacts facts = facts_of(own);
    std::array<std::uint64_t, 3> sums{facts.count, facts.low, facts.high};
    ranks.sum(sums);
    return {sums[0], sums[1], sums[2]};
}

/// Compares what all ranks found with what this one's device finds alone: `list`, or only the facts if there is none.
Check verdict_on(const PairFacts& facts, const std::optional<PairList>& list, Session& session,
                 const ClusterTask& task, const Scene& scene)
{
    Check check;
    check.verdict = Check::Verdict::agrees;
    check.against = "one device";
    if (list) {
        check.pairs_hash = list->hash();
        if (list->surplus() > 0)
            check.find_wrong(std::to_string(list->surplus()) + " pairs are found twice");
    }
    try {
        std::vector<Pair> right = pairs_of_one_device(session, task.pipeline, scene);
        const PairFacts wanted = facts_of(right);
        if (facts != wanted || (list && !(*list == PairList(std::move(right)))))
            check.find_wrong("it finds " + std::to_string(wanted.count) + " pairs, and not these");
    } catch (const Unavailable& error) {  // the scene may be too large for one device
        session.renew_queue();
        if (check.verdict == Check::Verdict::agrees)
            check.verdict = Check::Verdict::not_checked;
        check.detail +=
            (check.detail.empty() ? "" : "; ") + std::string("one device cannot: ") + error.what();
    }
    return check;
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
    ClusterFound found;
    ClusterResult& result = found.result;
    std::vector<RankFrame> frames;
    std::vector<Pair> own;
    std::uint64_t triangles = 0;
    {  // frees the device for the verdict
        const auto builder = make_builder(task.pipeline.builder, session.programs());
        const auto collider = make_collider(task.pipeline.collider, session.programs());
        DistributedFrame frame(ranks, session.programs(), session.queue(), *builder, *collider,
                               task.pipeline.collider.keep_adjacent);
        Share share = partitioned_share(first_share(task, session, ranks, result.scene),
                                        task.partition, ranks, result.partition_ns);
        triangles = share.triangle_count();
        const auto watched = [&](const auto& work) {
            const watchdog::Watch watch;
            return work();
        };
        watched([&] { frame.take(std::move(share)); });
        watched([&] { frame.run(); });  // buffers grow
        for (int k = 0; k < task.samples; ++k)
            frames.push_back(watched([&] { return frame.run(); }));
        own = frame.pairs();
    }
    result.ranks = ranks_at_first(ranks, session, triangles, std::move(frames));
    result.pairs = facts_of_all(own, ranks);
    std::optional<PairList> list;
    if (task.wants_pairs || result.pairs.count <= task.most_gathered) {
        std::vector<Pair> all;
        for (std::vector<Pair>& of_rank : at_first(ranks, std::move(own))) {
            all.insert(all.end(), of_rank.begin(), of_rank.end());
            of_rank = {};
        }
        list.emplace(std::move(all));
    }
    if (ranks.rank() != first_rank)
        return found;
    found.scene = whole_scene(task, session);
    result.scene.content_hash = found.scene.content_hash;
    result.partition = task.partition;
    result.pipeline = task.pipeline;
    result.shares_devices = task.share_devices;
    result.check = verdict_on(result.pairs, list, session, task, found.scene);
    if (list)
        found.pairs = *std::move(list);
    return found;
}

}  // namespace bvhbench
