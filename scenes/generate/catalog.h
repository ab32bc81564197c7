// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "geometry/mesh.h"
#include "scenes/scene.h"

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

/// A generator of objects that move.
struct MovingGenerator {
    std::string_view name;
    Scene (*make)(uint triangles, uint frames);
    uint least;  ///< triangles: one for each object
    std::string_view summary;

    static constexpr uint most = 0x10000000u;     ///< triangles
    static constexpr uint bytes_a_triangle = 48;  ///< of memory, about, and
    static constexpr uint bytes_a_frame = 7;      ///< a triangle
    static constexpr uint usual_frames = 16, most_frames = 1000;
};

/// All generators of scenes over time, of exactly N triangles.
std::span<const MovingGenerator> moving_generators();

}  // namespace bvhbench
