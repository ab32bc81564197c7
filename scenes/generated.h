// SPDX-License-Identifier: MIT
//
// Generated scenes by their names, as "torus:100000", "n-body:6100:4" or "worlds:64:60".
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "scenes/scene.h"

namespace bvhbench {

/// True if the name begins with that of a generator.
bool is_generated(std::string_view text);

/// Makes the scene. Nothing if no generator is called so. Throws BadUsage for counts that it cannot have, and Unavailable if the host
/// lacks the memory.
std::optional<Scene> generated(std::string_view text);

/// Returns the number of triangles that the name asks for. As generated().
std::optional<std::size_t> generated_triangles(std::string_view text);

}  // namespace bvhbench
