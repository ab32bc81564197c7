// SPDX-License-Identifier: MIT
//
// What `bvhbench cluster` found and measured, and the cell of a result file that says so. plots/console/rank_table.py prints it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cluster/frame.h"
#include "cluster/simulate.h"
#include "harness/choice/cluster_task.h"
#include "harness/record/record.h"

namespace bvhbench {

struct ClusterRank {
    std::string host, device;
    std::uint64_t triangles = 0;
    /// Of the device, by a trial with some of the triangles; 0: no trial.
    std::uint64_t predicted_bytes = 0;
    std::uint64_t device_bytes = 0;  ///< most that were taken at a time
    std::uint64_t host_bytes = 0;    ///< most that the process had
    std::vector<RankFrame> frames;   ///< timed ones; at least one
};

/// A frame of a scene that moves.
struct ClusterFrame {
    std::size_t frame = 0;
    PairFacts pairs = {};
    std::optional<PairFacts> contacts = {};
    /// Of work, triangles and pairs: the most of a rank, divided by the mean.
    double imbalance = 1;
    std::uint64_t moved_triangles = 0;  ///< to other ranks, after the frame
    std::int64_t rebalance_ns = 0;  ///< host clock: cutting and moving; 0 if the partition was kept
};

struct ClusterResult {
    ClusterTask task;
    SceneFacts scene;
    std::int64_t partition_ns = 0;  ///< host clock: cutting, and moving triangles to their ranks
    std::vector<ClusterRank> ranks;
    PairFacts pairs;                    ///< of all ranks together
    std::optional<PairFacts> contacts;  ///< the pairs that intersect; empty without a narrow phase
    std::vector<ClusterFrame> frames;   ///< of a scene that moves; the samples of ranks are theirs
    Check check;                        ///< has no hash of the list if only facts were compared
};

/// What ranks would do, counted without running them.
struct Simulation {
    ClusterTask task;
    SceneFacts scene = {};
    std::int64_t part_ns = 0;  ///< host clock: a frame of the largest part alone, on this device
    std::vector<SimulatedRank> ranks = {};
};

/// Returns a cell that says what was asked for and has no measurements yet.
Cell planned_cell(const ClusterTask& task);

/// Returns the cell of a result file. Ranks that may share a device have no times, because these mean nothing.
Cell cell_of(const ClusterResult& result);
Cell cell_of(const Simulation& simulation);

}  // namespace bvhbench
