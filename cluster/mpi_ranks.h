// SPDX-License-Identifier: MIT
//
// Ranks that are processes of MPI. This header does not include MPI's; without the library, no_mpi.cpp takes the place of
// mpi_ranks.cpp.
#pragma once

#include <memory>
#include <string>

#include "cluster/ranks.h"

namespace bvhbench {

/// This process as a rank on a host.
class HostedRanks : public Ranks {
public:
    virtual uint local_rank() const = 0;   ///< among the ranks of this host, from 0 on
    virtual uint local_count() const = 0;  ///< ranks of this host
    virtual const std::string& host() const = 0;

    /// Ends all ranks with this exit code, without waiting for them. Does not return.
    virtual void end_all(int code) = 0;
};

/// Why this program has no ranks of MPI, as a sentence; empty if it has.
std::string mpi_absent();

/// Name and version of the library that ranks talk through; empty without one.
std::string mpi_version();

inline constexpr std::size_t usual_most_at_once = std::size_t{1} << 30;
inline constexpr uint usual_most_dense = 64;

/// Starts MPI, which the destructor ends. At most once in a process. `most_at_once`: bytes that one message carries; longer ones
/// are sent in pieces, because MPI counts by int. `most_dense`: with more ranks, sizes of messages go only to ranks that get one. Throws
/// Unavailable with mpi_absent().
std::unique_ptr<HostedRanks> start_mpi(std::size_t most_at_once = usual_most_at_once,
                                       uint most_dense = usual_most_dense);

}  // namespace bvhbench
