// SPDX-License-Identifier: MIT
//
// Ranks that are the processes of a communicator of MPI which others made.
#pragma once

#include <mpi.h>

#include <memory>

#include "cluster/mpi_ranks.h"

namespace bvhbench {

/// Returns this process as a rank of `comm`, an intracommunicator. Duplicates it, so that messages do not mix with those of others,
/// and frees the duplicate at the end. All its processes must call. An error of MPI ends them all.
std::unique_ptr<HostedRanks> ranks_of(MPI_Comm comm);

}  // namespace bvhbench
