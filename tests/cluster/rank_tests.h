// SPDX-License-Identifier: MIT
//
// Tests that mpirun runs with several ranks: each rank runs all of them, and all fail if one does.
#pragma once

#include <gtest/gtest.h>

#include "cluster/mpi_ranks.h"

namespace bvhbench {

inline HostedRanks* ranks = nullptr;  ///< of this process; MPI starts once

/// Runs the tests of the program. `most_at_once` and `most_dense` as in start_mpi. Returns the exit code.
inline int run_rank_tests(int argc, char** argv, std::size_t most_at_once, uint most_dense = 64)
{
    testing::InitGoogleTest(&argc, argv);
    const auto started = start_mpi(most_at_once, most_dense);
    ranks = started.get();
    std::uint64_t failed[] = {RUN_ALL_TESTS() == 0 ? 0u : 1u};
    started->sum(failed);
    return failed[0] == 0 ? 0 : 1;
}

}  // namespace bvhbench
