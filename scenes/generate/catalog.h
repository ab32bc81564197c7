// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "geometry/mesh.h"

namespace bvhbench {

struct Generator {
    std::string_view name;
    Mesh (*make)(uint triangles);
    uint most;              ///< triangles, so that vertex indices fit 32 bits
    uint bytes_a_triangle;  ///< of memory, about
    std::string_view summary;
};

/// All generators of exactly N triangles, one line each.
std::span<const Generator> generators();

}  // namespace bvhbench
