// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

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
/// Where floats cannot hold what any of those files says, all frames are rounded alike, as `library.doubles` says.
///
/// Throws Unavailable. The caller names the result and makes it `finished`.
Scene read_sequence(const std::filesystem::path& folder, const SceneLibrary& library);

/// Takes names of objects and labels of frames from `meta.json`, if it is there, and holds the rest of what it
/// says about them to `scene`, whose mesh and frames were read. Where the mesh names no objects, the table's are
/// taken. Throws Unavailable, in one sentence, when the two disagree or the file is not understood.
void add_sequence_facts(Scene& scene, const std::filesystem::path& meta);

/// What `meta.json` says under `ccd` about the step between two of its frames: how many pairs of vertices and faces (vf)
/// and of edges (ee) are listed as ground truth, how many of those collide, and how many pairs of swept boxes overlap.
struct StepFacts {
    std::size_t from_frame = 0;
    std::optional<std::uint64_t> vf_listed, vf_true, ee_listed, ee_true, swept_vf, swept_ee;
};

/// Of frames that `scene` was read with; nothing if the file is not there or does not say. Throws as above.
std::optional<StepFacts> step_facts(const Scene& scene, const std::filesystem::path& meta);

}  // namespace bvhbench
