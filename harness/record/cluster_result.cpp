// SPDX-License-Identifier: MIT
#include "harness/record/cluster_result.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <set>

#include "cluster/share.h"
#include "geometry/hash.h"
#include "harness/base/table.h"
#include "scenes/catalog.h"

namespace bvhbench {
namespace {

std::int64_t median(std::vector<std::int64_t> values)
{
    std::ranges::sort(values);
    return values[values.size() / 2];
}

std::int64_t median_over(const std::vector<RankFrame>& frames,
                         const std::function<std::int64_t(const RankFrame&)>& value)
{
    std::vector<std::int64_t> values;
    std::ranges::transform(frames, std::back_inserter(values), value);
    return median(std::move(values));
}

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
    if (rank.predicted_bytes != 0)
        json["predicted_device_bytes"] = rank.predicted_bytes;
    json["samples"] = Json::array();
    if (with_times)
        for (const RankFrame& frame : rank.frames)
            json["samples"].push_back(frame_json(frame));
    return json;
}

std::uint64_t halo_sent(const ClusterResult& result)
{
    std::uint64_t sum = 0;
    for (const ClusterRank& rank : result.ranks)
        sum += rank.frames.back().halo_sent;
    return sum;
}

/// Returns how many times the mean the largest number of triangles of a rank is.
double imbalance(const ClusterResult& result)
{
    const auto most = std::ranges::max(result.ranks, {}, &ClusterRank::triangles).triangles;
    return static_cast<double>(most) * static_cast<double>(result.ranks.size()) /
           static_cast<double>(result.scene.triangles);
}

double halo_share(const ClusterResult& result)
{
    return static_cast<double>(halo_sent(result)) / static_cast<double>(result.scene.triangles);
}

std::string set_hash(const PairFacts& pairs) { return hex(pairs.high) + hex(pairs.low); }

std::string verdict_line(const ClusterResult& result)
{
    const Check& check = result.check;
    std::string line = check.verdict == Check::Verdict::agrees
                           ? "verdict: agrees with " + check.against
                       : check.verdict == Check::Verdict::differs
                           ? "verdict: DIFFERS from " + check.against + ": " + check.detail
                           : "verdict: not checked: " + check.detail;
    line +=
        ", pairs " + std::to_string(result.pairs.count) + ", set hash " + set_hash(result.pairs);
    if (result.contacts)
        line += ", contacts " + std::to_string(result.contacts->count) + ", set hash " +
                set_hash(*result.contacts);
    return line;
}

/// Returns a line on the frames of a scene that moves; empty for another one.
std::string frames_lines(const ClusterResult& result)
{
    if (result.frames.empty())
        return {};
    std::uint64_t moved = 0, times = 0;
    double most = 1;
    for (const ClusterFrame& frame : result.frames) {
        moved += frame.moved_triangles;
        times += frame.moved_triangles > 0 ? 1 : 0;
        most = std::max(most, frame.imbalance);
    }
    std::array<char, 32> ratio{};
    std::snprintf(ratio.data(), ratio.size(), "%.3f", most);
    return std::to_string(result.frames.size()) + " frames; work of a rank at most " +
           ratio.data() + " of the mean; rebalanced " + std::to_string(times) + " times, " +
           std::to_string(moved) + " triangles moved, " +
           bytes_text(static_cast<double>(moved * sizeof(CarriedTriangle))) + "\n";
}

/// Returns a row for each rank: what it has, sends and finds.
Table counts_table(const ClusterResult& result)
{
    Table table({{"rank"},
                 {"host", Table::Align::left},
                 {"triangles"},
                 {"halo sent"},
                 {"received"},
                 {"bytes sent"},
                 {"own pairs"},
                 {"halo pairs"}});
    for (std::size_t k = 0; k < result.ranks.size(); ++k) {
        const ClusterRank& rank = result.ranks[k];
        const RankFrame& last = rank.frames.back();
        table.row({std::to_string(k), rank.host, std::to_string(rank.triangles),
                   std::to_string(last.halo_sent), std::to_string(last.halo_received),
                   bytes_text(static_cast<double>(last.sent_bytes)), std::to_string(last.own_pairs),
                   std::to_string(last.halo_pairs)});
    }
    return table;
}

/// Returns two rows for each rank: the times of its stages by the clocks of host and device.
Table times_table(const ClusterResult& result)
{
    std::vector<Table::Column> columns = {{"rank"}, {"clock", Table::Align::left}};
    for (const std::string_view stage : frame_stages)
        columns.push_back({std::string(stage)});
    columns.push_back({"whole"});
    Table table(columns);
    for (std::size_t k = 0; k < result.ranks.size(); ++k) {
        const std::vector<RankFrame>& frames = result.ranks[k].frames;
        const auto time = [&](const std::function<std::int64_t(const RankFrame&)>& value) {
            return duration_text(static_cast<double>(median_over(frames, value)));
        };
        std::vector<std::string> host = {std::to_string(k), "host"}, device = {"", "device"};
        for (std::size_t stage = 0; stage < frame_stage_count; ++stage) {
            host.push_back(time([&](const RankFrame& frame) { return frame.host_ns[stage]; }));
            const auto on_device = [&](const RankFrame& frame) { return frame.device_ns[stage]; };
            device.push_back(median_over(frames, on_device) == 0 ? "" : time(on_device));
        }
        host.push_back(time(&RankFrame::whole_ns));
        table.row(std::move(host));
        table.row(std::move(device));
    }
    return table;
}

}  // namespace

std::int64_t frame_ns(const ClusterResult& result)
{
    std::vector<std::int64_t> frames(result.ranks.front().frames.size());
    for (const ClusterRank& rank : result.ranks)
        for (std::size_t k = 0; k < frames.size(); ++k)
            frames[k] = std::max(frames[k], rank.frames[k].whole_ns);
    return median(std::move(frames));
}

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
    Cell cell = planned_cell(result.task);
    cell.scene.triangles = result.scene.triangles;
    cell.scene.vertices = result.scene.vertices;
    cell.scene.content_hash = result.scene.content_hash;
    cell.check = result.check;
    Json& json = cell.cluster;
    if (has_times) {
        json["partition_ns"] = result.partition_ns;
        json["frame_ns"] = frame_ns(result);
    }
    json["halo_share"] = halo_share(result);
    json["imbalance"] = imbalance(result);
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
    json["ranks"] = Json::array();
    for (const ClusterRank& rank : result.ranks)
        json["ranks"].push_back(rank_json(rank, has_times));
    return cell;
}

std::string cluster_table(const ClusterResult& result, std::size_t width)
{
    std::set<std::string> devices;
    for (const ClusterRank& rank : result.ranks)
        devices.insert(rank.device);
    std::string text =
        result.scene.name + " (" + std::to_string(result.scene.triangles) + " triangles), " +
        result.task.pipeline.collider.name + " over " + result.task.pipeline.builder.name + ", " +
        std::to_string(result.ranks.size()) + (result.ranks.size() == 1 ? " rank, " : " ranks, ") +
        std::string(partition_names[static_cast<std::size_t>(result.task.partition)]);
    for (const std::string& device : devices)
        text += "\ndevice: " + device;
    text += "\n" + counts_table(result).text(width);
    text += frames_lines(result);
    if (!result.task.share_devices)
        text += times_table(result).text(width);
    text += "halo: " + fixed(100 * halo_share(result), 1) +
            " % of the triangles; imbalance: " + fixed(imbalance(result), 3) + " of the mean\n";
    text += result.task.share_devices
                ? "ranks share a device: their times mean nothing and are left out\n"
                : "frame: " + duration_text(static_cast<double>(frame_ns(result))) +
                      " by the host's clock, median of " +
                      std::to_string(result.ranks.front().frames.size()) + "; partition, once: " +
                      duration_text(static_cast<double>(result.partition_ns)) + "\n";
    return text + verdict_line(result) + "\n";
}

}  // namespace bvhbench
