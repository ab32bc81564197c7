// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "collide/pairs.h"

namespace bvhbench {

/// How a list of pairs differs from the right one. Found twice counts as false.
struct Differences {
    std::uint64_t missed = 0;
    std::uint64_t false_ones = 0;

    Differences& operator+=(const Differences& more)
    {
        missed += more.missed;
        false_ones += more.false_ones;
        return *this;
    }
    bool operator==(const Differences&) const = default;
};

Differences differences(const PairList& found, const PairList& right);

}  // namespace bvhbench
