// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "scenes/formats/formats.h"

namespace bvhbench {

/// Whether assimp has a reader for files that end in `extension` (".gltf").
bool assimp_knows(const std::string& extension);

/// Reads with assimp in this process, which may crash it: see mesh_worker.h. Nothing is merged; points and
/// lines are passed over; polygons are cut into fans. Throws Unavailable.
FileMesh read_with_assimp(const std::string& path);

}  // namespace bvhbench
