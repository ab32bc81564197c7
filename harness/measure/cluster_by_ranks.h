// SPDX-License-Identifier: MIT
#pragma once

#include "harness/base/common_options.h"
#include "harness/measure/cluster.h"

namespace bvhbench {

/// Starts `task.ranks` processes of `cluster` by mpirun and returns the cell that they write. Throws BadUsage, Unavailable or
/// NothingMeasured with what a rank said if they write none.
Json cell_by_ranks(const ClusterTask& task, const CommonOptions& common);

/// Returns the facts of a run, with what ranks talk through: the MPI library, and the links of NVIDIA's devices.
Json with_cluster_facts(Json run);

}  // namespace bvhbench
