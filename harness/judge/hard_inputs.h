// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "geometry/mesh.h"

namespace bvhbench {

/// A way to make triangles on which builders have failed.
struct HardInput {
    std::string_view name;
    Mesh (*make)(std::size_t triangles);  ///< the same for the same number, on every machine
};

/// All of them, in the order `check` lists them.
std::span<const HardInput> hard_inputs();

/// Sizes that tell: one below, at and above powers of two, where implicit layouts go wrong.
std::span<const std::size_t> telling_sizes();

}  // namespace bvhbench
