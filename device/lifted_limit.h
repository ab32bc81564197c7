// SPDX-License-Identifier: MIT
#pragma once

#include <sys/resource.h>

namespace bvhbench {

/// Raises the soft limit RLIMIT_DATA to the hard limit while a driver starts or compiles. When PoCL starts, it takes the limit
/// as its device's memory size and ends the process if that is below 128 MiB. If an allocation in its compiler fails, a lock
/// stays held and the next call hangs. device/program.cpp checks beforehand that the host has memory for a compilation.
class LiftedLimit {
public:
    LiftedLimit()
    {
        getrlimit(RLIMIT_DATA, &before_);
        const rlimit lifted{before_.rlim_max, before_.rlim_max};
        setrlimit(RLIMIT_DATA, &lifted);
    }
    ~LiftedLimit() { setrlimit(RLIMIT_DATA, &before_); }
    LiftedLimit(const LiftedLimit&) = delete;
    LiftedLimit& operator=(const LiftedLimit&) = delete;

private:
    rlimit before_ = {};
};

}  // namespace bvhbench
