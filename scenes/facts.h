// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "scenes/scene.h"

namespace bvhbench {

/// Returns the facts about a finished scene. Pairs are estimated by `samples` triangles, fewer of a large scene, whose boxes are tested
/// against all.
MeshFacts mesh_facts(const Scene& scene, std::size_t samples);

/// Returns what will surprise about a scene that was read from a file, in one line; empty if nothing does.
std::string surprises(const Scene& scene);

/// Joins vertices that have the same position in all frames, and returns the scene finished again. Corners keep the smallest of
/// their indices; vertices behind one that goes move up. Objects that are connected components are found again.
Scene welded(Scene scene);

}  // namespace bvhbench
