// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "scenes/scene.h"

namespace bvhbench {

/// Takes names of objects and labels of frames from `meta.json`, if it is there, and holds the rest of what it
/// says about them to `scene`, whose mesh and frames were read. Where the mesh names no objects, the table's are
/// taken. Throws Unavailable, in one sentence, when the two disagree or the file is not understood.
void add_sequence_facts(Scene& scene, const std::filesystem::path& meta);

}  // namespace bvhbench
