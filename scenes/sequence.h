// SPDX-License-Identifier: MIT
#pragma once

#include "scenes/mesh_file.h"

namespace bvhbench {

/// The scene in a folder of frames that share one connectivity. Either
///
///     mesh.ply     connectivity, and objects by `object_id`, in any order of faces
///     frames.f32   for each frame, the positions of all vertices: three little-endian floats each
///     meta.json    if it is there: names of objects, labels of frames, counts that are checked
///
/// or mesh files whose names differ in a number, one a frame, in the order of those numbers. Where these
/// name no objects, connected parts are objects.
///
/// Where floats cannot hold what any of those files says, all frames are rounded alike, as `doubles` says.
///
/// Throws Unavailable. The caller names the result and makes it `finished`.
Scene read_sequence(const std::filesystem::path& folder, const WorkerLimits& limits,
                    Doubles doubles);

}  // namespace bvhbench
