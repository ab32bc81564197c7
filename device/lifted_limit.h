// SPDX-License-Identifier: MIT
#pragma once

#include <sys/resource.h>

namespace bvhbench {

/// Lifts RLIMIT_DATA while a driver starts or compiles. PoCL takes the limit for the memory of its device when it starts, and
/// ends the process if that is less than 128 MiB; an allocation that fails in its compiler leaves a lock behind that the next
/// call waits for without end. What a compilation takes is asked for before (device/program.cpp).
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
