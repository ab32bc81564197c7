// SPDX-License-Identifier: MIT
//
// Starts this program as several ranks of MPI, by mpirun, and tells how they ended.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace bvhbench {

/// Returns the number of ranks that mpirun or Slurm started this process with; nothing if neither did.
std::optional<unsigned> ranks_started();

/// Runs this program with `words` on this host as `ranks` ranks, with mpirun's settings for root, containers and more ranks than
/// cores. Rank 0 prints. Returns the exit code. A rank that ends with an error is to print a sentence, which is printed here once.
///
/// If this process ends, so do the ranks. Throws Unavailable if mpirun is missing or fails, NothingMeasured if a signal ended a rank.
int run_ranks(unsigned ranks, const std::vector<std::string>& words);

}  // namespace bvhbench
