// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "geometry/mesh.h"

namespace bvhbench {

/// A generator of triangles on which builders have failed.
struct HardInput {
    std::string_view name;
    Mesh (*make)(std::size_t triangles);  ///< same result for the same number on every machine
};

/// Returns all of them, in the order in which `check` lists them.
std::span<const HardInput> hard_inputs();

/// Returns numbers of triangles one below, at and one above powers of two, where implicit layouts fail first.
std::span<const std::size_t> critical_sizes();

}  // namespace bvhbench
