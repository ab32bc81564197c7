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

/// The exit code of ranks, and the sentence of the one that failed; empty if none did, or if it said why in its table.
struct RanksEnd {
    int code = 0;
    std::string sentence = {};
};

/// Runs this program with `words` on this host as `ranks` ranks, with mpirun's settings for root, containers and more ranks than
/// cores. `columns` is the width of rank 0's terminal. A rank that ends with an error is to print a sentence, which is returned.
///
/// If this process ends, so do the ranks. If mpirun hangs (process/mpirun_watch.h), it is killed, and so is all that it
/// started. Throws Unavailable if mpirun is missing, fails or does not start all ranks, NothingMeasured if a signal ended a rank or
/// mpirun did not end after a rank had. `time_limit_s`: as in CommonOptions.
RanksEnd run_ranks(unsigned ranks, const std::vector<std::string>& words, std::size_t columns,
                   double time_limit_s);

}  // namespace bvhbench
