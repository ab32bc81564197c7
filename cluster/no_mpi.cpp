// SPDX-License-Identifier: MIT
#include "cluster/mpi_ranks.h"
#include "geometry/error.h"

namespace bvhbench {

std::string mpi_absent() { return "built without MPI (libopenmpi-dev), which ranks talk through"; }

std::string mpi_version() { return {}; }

std::unique_ptr<HostedRanks> start_mpi(std::size_t, uint) { throw Unavailable(mpi_absent()); }

}  // namespace bvhbench
