// SPDX-License-Identifier: MIT
#include "harness/record/simulation.h"

#include <algorithm>
#include <cstdio>

#include "cluster/halo_query.h"
#include "harness/base/table.h"
#include "harness/record/cluster_result.h"

namespace bvhbench {
namespace {

using Member = std::uint64_t SimulatedRank::*;

std::uint64_t most(const Simulation& simulation, Member member)
{
    return std::ranges::max(simulation.ranks, {}, member).*member;
}

double mean(const Simulation& simulation, Member member)
{
    double sum = 0;
    for (const SimulatedRank& rank : simulation.ranks)
        sum += static_cast<double>(rank.*member);
    return sum / static_cast<double>(simulation.ranks.size());
}

double halo_share(const Simulation& simulation)
{
    return mean(simulation, &SimulatedRank::halo_sent) /
           mean(simulation, &SimulatedRank::triangles);
}

double imbalance(const Simulation& simulation)
{
    return static_cast<double>(most(simulation, &SimulatedRank::triangles)) /
           mean(simulation, &SimulatedRank::triangles);
}

/// Returns the time of a frame by the model: that of the largest part, and what ranks tell each other.
std::int64_t model_ns(const Simulation& simulation)
{
    return simulation.part_ns + exchange_ns(simulation.ranks, simulation.task.boxes);
}

std::uint64_t box_bytes(const Simulation& simulation)
{
    return (simulation.ranks.size() - 1) * simulation.task.boxes * sizeof(Aabb);
}

}  // namespace

Cell cell_of(const Simulation& simulation)
{
    Cell cell = planned_cell(simulation.task);
    cell.scene.triangles = simulation.scene.triangles;
    cell.scene.vertices = simulation.scene.vertices;
    cell.check.detail = "what ranks would send was counted, and no pairs were found";
    Json& json = cell.cluster;
    json.update({{"halo_share", halo_share(simulation)},
                 {"imbalance", imbalance(simulation)},
                 {"box_bytes", box_bytes(simulation)},
                 {"part_ns", simulation.part_ns},
                 {"model_ns", model_ns(simulation)},
                 {"ranks", Json::array()}});
    for (const SimulatedRank& rank : simulation.ranks)
        json["ranks"].push_back({{"triangles", rank.triangles},
                                 {"halo_sent_count", rank.halo_sent},
                                 {"halo_received_count", rank.halo_received},
                                 {"targets_count", rank.targets},
                                 {"sources_count", rank.sources}});
    return cell;
}

std::string simulation_text(const Simulation& simulation)
{
    const auto line = [](const char* format, auto... values) {
        char text[256];
        std::snprintf(text, sizeof text, format, values...);
        return std::string(text);
    };
    const auto halo_bytes = [](double triangles) {
        return bytes_text(triangles * sizeof(HaloTriangle));
    };
    const double sent = mean(simulation, &SimulatedRank::halo_sent);
    const auto most_sent = static_cast<double>(most(simulation, &SimulatedRank::halo_sent));
    const auto most_received = static_cast<double>(most(simulation, &SimulatedRank::halo_received));
    return simulation.scene.name + " (" + std::to_string(simulation.scene.triangles) +
           " triangles) on " + std::to_string(simulation.ranks.size()) +
           (simulation.ranks.size() == 1 ? " rank" : " ranks") + ", simulated: " +
           std::string(partition_names[static_cast<std::size_t>(simulation.task.partition)]) +
           ", " + simulation.task.pipeline.builder.name + ", " +
           std::to_string(simulation.task.boxes) + " boxes a rank\n" +
           line("halo: %.1f %% of the triangles; imbalance: %.3f of the mean\n",
                100 * halo_share(simulation), imbalance(simulation)) +
           "a frame of a rank sends " + halo_bytes(sent) + " of triangles in the mean, " +
           halo_bytes(most_sent) + " at most, and receives " + halo_bytes(most_received) +
           " at most\n" +
           line("messages: %.1f in the mean, %llu at most to others, %llu at most from others\n",
                mean(simulation, &SimulatedRank::targets),
                static_cast<unsigned long long>(most(simulation, &SimulatedRank::targets)),
                static_cast<unsigned long long>(most(simulation, &SimulatedRank::sources))) +
           "boxes of all other ranks, received by each: " +
           bytes_text(static_cast<double>(box_bytes(simulation))) +
           "\na frame by the model: " + duration_text(static_cast<double>(model_ns(simulation))) +
           ", of which the largest part takes " +
           duration_text(static_cast<double>(simulation.part_ns)) + " on this device\n";
}

}  // namespace bvhbench
