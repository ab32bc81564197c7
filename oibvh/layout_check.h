// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "oibvh/layout.h"

namespace bvhbench {

/// The first formula of layout.h that contradicts arithmetic in 64 bits, a level at a time, over so many leaves, up to
/// 2^31; empty if none does. Looks at each level's counts, its first, middle and last nodes and those just beyond, and
/// at the sums over all levels. `shape` is what `oi_shape` says, or what a test puts in its place.
std::string broken_layout(std::uint64_t leaves, OiShape shape);

/// Of the shape that `oi_shape` says.
std::string broken_layout(uint leaves);

}  // namespace bvhbench
