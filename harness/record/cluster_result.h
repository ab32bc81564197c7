// SPDX-License-Identifier: MIT
//
// What `bvhbench cluster` found and measured, as a table and as a file (results/schema/cluster-1.schema.json).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cluster/frame.h"
#include "cluster/partition.h"
#include "harness/base/json_keys.h"
#include "harness/choice/scene_choice.h"
#include "harness/record/record.h"

namespace bvhbench {

struct ClusterRank {
    std::string host, device;
    std::uint64_t triangles = 0;
    std::uint64_t predicted_bytes =
        0;  ///< of the device, by a trial with some of the triangles; 0: no trial
    std::uint64_t device_bytes = 0;  ///< most that were taken at a time
    std::uint64_t host_bytes = 0;    ///< most that the process had
    std::vector<RankFrame> frames;   ///< timed ones; at least one
};

/// A frame of a scene that moves.
struct ClusterFrame {
    std::size_t frame = 0;
    PairFacts pairs;
    std::optional<PairFacts> contacts;
    double imbalance =
        1;  ///< of work, triangles and pairs: the most of a rank, divided by the mean
    std::uint64_t moved_triangles = 0;  ///< to other ranks, after the frame
    std::int64_t rebalance_ns = 0;  ///< host clock: cutting and moving; 0 if the partition was kept
};

struct ClusterResult {
    SceneFacts scene;
    PartitionBy partition = PartitionBy::rcb;
    PipelineChoice pipeline;
    unsigned boxes = 0;  ///< that each rank told all others
    bool shares_devices =
        false;  ///< several ranks had one device: times mean nothing and are left out
    std::int64_t partition_ns = 0;  ///< host clock: cutting, and moving triangles to their ranks
    std::vector<ClusterRank> ranks;
    PairFacts pairs;                    ///< of all ranks together
    std::optional<PairFacts> contacts;  ///< the pairs that intersect; empty without a narrow phase
    std::vector<ClusterFrame> frames;   ///< of a scene that moves; the samples of ranks are theirs
    Check check;                        ///< has no hash of the list if only facts were compared
};

/// Returns the document, with `run`, the facts of the run, and the MPI library's name.
Json cluster_json(const ClusterResult& result, Json run, const std::string& mpi);

/// Returns a table with a row for each rank, medians over its frames, and lines that sum up. `width`: as Table::text.
std::string cluster_table(const ClusterResult& result, std::size_t width);

/// Returns the time of a frame in nanoseconds, by the median over frames: that of the last rank to finish.
std::int64_t frame_ns(const ClusterResult& result);

}  // namespace bvhbench
