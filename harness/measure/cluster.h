// SPDX-License-Identifier: MIT
#pragma once

#include "cluster/mpi_ranks.h"
#include "collide/pairs.h"
#include "harness/base/common_options.h"
#include "harness/record/cluster_result.h"
#include "harness/session/session.h"

namespace bvhbench {

/// What rank 0 has at the end; the other ranks have empty ones.
struct ClusterFound {
    Scene scene;        ///< all triangles as one object
    PairList contacts;  ///< as `pairs`
    PairList pairs;     ///< of all ranks; empty if they are too many to be gathered unasked
    ClusterResult result;
};

/// Returns the words for the device of this rank: each rank of a host has another one of those that `words` match. Throws
/// Unavailable if there are fewer than ranks, unless they may share.
std::string device_of_rank(const std::string& words, const HostedRanks& ranks, bool share_devices);

/// Runs this rank's part: rank 0 reads the scene, all ranks distribute it and find the pairs of its first frame, and rank 0 compares
/// them with those that its device finds alone. Throws what reading the scene, builders and colliders throw; the other ranks then
/// wait, so the caller ends them.
ClusterFound run_cluster(HostedRanks& ranks, Session& session, const ClusterTask& task);

/// Counts what each of `task.simulates` ranks would send and receive, without running them, and times the largest part on this device.
Simulation simulate_cluster(Session& session, const ClusterTask& task);

/// Starts `task.ranks` processes of `cluster` by mpirun and returns the cell that they write. Throws BadUsage, Unavailable or
/// NothingMeasured with what a rank said if they write none.
Json cell_by_ranks(const ClusterTask& task, const CommonOptions& common);

/// Returns the facts of a run, with what ranks talk through: the MPI library, and the links of NVIDIA's devices.
Json with_cluster_facts(Json run);

}  // namespace bvhbench
