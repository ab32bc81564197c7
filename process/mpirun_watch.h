// SPDX-License-Identifier: MIT
//
// Open MPI's mpirun can wait for ever: of some 50 ranks that were killed within 0.1 s of their start, it missed the end of one.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <vector>

#include "process/family.h"

namespace bvhbench {

/// Tells from the processes of this host whether mpirun hangs. A rank is a child of mpirun that runs this program.
class MpirunWatch {
public:
    enum class State {
        ranks_run,
        starts_too_few,  ///< for limit_s() it has not started all ranks
        ends_too_few,    ///< that long ago mpirun or a rank ended, and others have not ended
    };

    /// `limit_s` is 60, or less with a smaller `time_limit_s` (CommonOptions).
    MpirunWatch(pid_t mpirun, const ProcessFamily& family, unsigned ranks, double time_limit_s);

    State state();
    double limit_s() const { return limit_.count(); }
    std::size_t started_ranks() const { return ranks_.size(); }

    /// Returns how long to wait before state() is asked again: briefly until all ranks were seen.
    std::chrono::milliseconds pause() const;

private:
    using Clock = std::chrono::steady_clock;

    pid_t mpirun_;
    const ProcessFamily& family_;  ///< mpirun and all that it starts
    unsigned wanted_;
    std::chrono::duration<double> limit_;
    Clock::time_point started_ = Clock::now();
    std::vector<pid_t> ranks_;  ///< that were seen
    std::optional<Clock::time_point>
        ended_;  ///< when mpirun or a rank was first seen to have ended
};

}  // namespace bvhbench
