// SPDX-License-Identifier: MIT
#include "harness/record/cluster_result.h"

#include <algorithm>

#include "cluster/share.h"
#include "geometry/hash.h"
#include "scenes/catalog.h"

namespace bvhbench {
namespace {

Json frame_json(const RankFrame& frame)
{
    Json stages = Json::array();
    for (std::size_t k = 0; k < frame_stage_count; ++k)
        stages.push_back({{"stage", frame_stages[k]},
                          {"host_ns", frame.host_ns[k]},
                          {"device_ns", frame.device_ns[k]}});
    return {{"whole_ns", frame.whole_ns}, {"stages", stages}};
}

Json rank_json(const ClusterRank& rank, bool with_times)
{
    const RankFrame& last = rank.frames.back();
    Json json = {{"host", rank.host},
                 {"device", rank.device},
                 {"triangles", rank.triangles},
                 {"device_peak_bytes", rank.device_bytes},
                 {"host_peak_bytes", rank.host_bytes},
                 {"halo_sent_count", last.halo_sent},
                 {"halo_received_count", last.halo_received},
                 {"sent_bytes", last.sent_bytes},
                 {"own_pairs_count", last.own_pairs},
                 {"halo_pairs_count", last.halo_pairs},
                 {"contacts_count", last.contacts}};
    put_if(json, "predicted_device_bytes", rank.predicted_bytes);
    json["samples"] = Json::array();
    if (with_times)
        for (const RankFrame& frame : rank.frames)
            json["samples"].push_back(frame_json(frame));
    return json;
}

/// Returns the time of a frame in nanoseconds, by the median over frames: that of the last rank to finish.
std::int64_t frame_ns(const ClusterResult& result)
{
    std::vector<std::int64_t> frames(result.ranks.front().frames.size());
    for (const ClusterRank& rank : result.ranks)
        for (std::size_t k = 0; k < frames.size(); ++k)
            frames[k] = std::max(frames[k], rank.frames[k].whole_ns);
    std::ranges::sort(frames);
    return frames[frames.size() / 2];
}

std::string set_hash(const PairFacts& pairs) { return hex(pairs.high) + hex(pairs.low); }

/// Returns the cell of a scene and its ranks, with the halo's share and the imbalance.
Cell cell_of(const ClusterTask& task, const SceneFacts& scene, Json ranks)
{
    double sent = 0, most = 0;
    for (const Json& rank : ranks) {
        sent += rank["halo_sent_count"].get<double>();
        most = std::max(most, rank["triangles"].get<double>());
    }
    Cell cell = planned_cell(task);
    cell.scene.triangles = scene.triangles;
    cell.scene.vertices = scene.vertices;
    cell.scene.content_hash = scene.content_hash;
    const auto triangles = static_cast<double>(scene.triangles);
    cell.cluster["halo_share"] = sent / triangles;
    cell.cluster["imbalance"] = most * static_cast<double>(ranks.size()) / triangles;
    cell.cluster["ranks"] = std::move(ranks);
    return cell;
}

}  // namespace

Cell planned_cell(const ClusterTask& task)
{
    Cell cell;
    cell.experiment = task.experiment;
    cell.scene.name = scene_name(task.scene);
    cell.scene.objects = 1;
    cell.scene.frame = static_cast<std::int64_t>(task.frames.first);
    cell.builder = task.pipeline.builder;
    cell.collider = task.pipeline.collider;
    cell.operation = Operation::cluster;
    cell.cluster = {{"ranks_count", std::max(task.ranks, task.simulates)},
                    {"simulated", task.simulates != 0},
                    {"partition", partition_names[static_cast<std::size_t>(task.partition)]},
                    {"boxes_count", task.boxes},
                    {"shares_devices", task.share_devices}};
    if (task.moves())
        cell.cluster.update(
            {{"asked_frames", frame_range_text(task.frames)}, {"rebalance", task.rebalance}});
    return cell;
}

Cell cell_of(const ClusterResult& result)
{
    const bool has_times = !result.task.share_devices;
    Json ranks = Json::array();
    for (const ClusterRank& rank : result.ranks)
        ranks.push_back(rank_json(rank, has_times));
    Cell cell = cell_of(result.task, result.scene, std::move(ranks));
    cell.check = result.check;
    cell.within_distance = result.task.pipeline.collider.distance;
    Json& json = cell.cluster;
    if (has_times) {
        json["partition_ns"] = result.partition_ns;
        json["frame_ns"] = frame_ns(result);
    }
    json["pairs_count"] = result.pairs.count;
    json["pairs_set_hash"] = set_hash(result.pairs);
    if (result.contacts) {
        json["contacts_count"] = result.contacts->count;
        json["contacts_set_hash"] = set_hash(*result.contacts);
    }
    for (const ClusterFrame& frame : result.frames) {
        Json one = {{"frame", frame.frame},
                    {"pairs_count", frame.pairs.count},
                    {"pairs_set_hash", set_hash(frame.pairs)},
                    {"work_imbalance", frame.imbalance},
                    {"moved_count", frame.moved_triangles},
                    {"moved_bytes", frame.moved_triangles * sizeof(CarriedTriangle)}};
        if (frame.contacts)
            one["contacts_count"] = frame.contacts->count;
        if (has_times)
            one["rebalance_ns"] = frame.rebalance_ns;
        json["frames"].push_back(std::move(one));
    }
    return cell;
}

Cell cell_of(const Simulation& simulation)
{
    Json ranks = Json::array();
    for (const SimulatedRank& rank : simulation.ranks)
        ranks.push_back({{"triangles", rank.triangles},
                         {"halo_sent_count", rank.halo_sent},
                         {"halo_received_count", rank.halo_received},
                         {"targets_count", rank.targets},
                         {"sources_count", rank.sources}});
    const unsigned boxes = simulation.task.boxes;
    Cell cell = cell_of(simulation.task, simulation.scene, std::move(ranks));
    cell.check.detail = "what ranks would send was counted, and no pairs were found";
    Json& json = cell.cluster;
    json["box_bytes"] = (simulation.ranks.size() - 1) * boxes * sizeof(Aabb);
    json["part_ns"] = simulation.part_ns;
    json["model_ns"] = simulation.part_ns + exchange_ns(simulation.ranks, boxes);
    return cell;
}

}  // namespace bvhbench
