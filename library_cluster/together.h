// SPDX-License-Identifier: MIT
//
// Failures that all ranks share.
#pragma once

#include <functional>

#include "cluster/agreeing_ranks.h"

namespace bvhbench::oibvh {

/// Runs `work`, as all ranks do; its messages go through `ranks`. If it fails on some ranks, all throw the failure of the lowest of
/// them as an Error of the library. Exceptions that are none become Unavailable.
void together(AgreeingRanks& ranks, const std::function<void()>& work);

}  // namespace bvhbench::oibvh
