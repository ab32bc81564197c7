// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "oibvh/layout.h"

namespace bvhbench {

/// Describes the first formula of layout.h that contradicts a level-by-level computation in 64 bits, for `leaves` up to 2^31;
/// empty if there is none. Checks each level's counts, some of its real nodes, its first and last virtual nodes, and the sums
/// over all levels. `shape` is that of `oi_shape`, or a test's substitute.
std::string layout_violation(std::uint64_t leaves, OiShape shape);

/// Checks the shape that `oi_shape` returns.
std::string layout_violation(uint leaves);

}  // namespace bvhbench
