// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "scenes/mesh_file.h"

namespace bvhbench {

/// Reads the scene in a folder of frames that share one connectivity. The folder holds either
///
///     mesh.ply     connectivity, and objects by `object_id`, with faces in any order
///     frames.f32   for each frame, the positions of all vertices: three little-endian floats each
///     meta.json    optional: names of objects, labels of frames, counts that are checked
///
/// or mesh files, one per frame, ordered by a number in their names. If they name no objects, connected components are objects.
///
/// If floats cannot hold the coordinates of any file, all frames are rounded in the same way, given by `library.doubles`.
///
/// Throws Unavailable. The caller sets the name and calls `finished`.
Scene read_sequence(const std::filesystem::path& folder, const SceneLibrary& library);

/// Takes the names of objects and labels of frames from `meta.json`, if it exists, and checks its other facts against `scene`,
/// whose mesh and frames were already read. If the mesh names no objects, those of meta.json's table are used. Throws
/// Unavailable, in one sentence, if the two disagree or the file is malformed.
void add_sequence_facts(Scene& scene, const std::filesystem::path& meta);

/// Facts in `meta.json` under `ccd` about the step between two frames: the numbers of vertex-face pairs (vf) and edge-edge
/// pairs (ee) listed as ground truth, of listed pairs that collide, and of pairs whose swept boxes overlap.
struct StepFacts {
    std::size_t from_frame = 0;
    std::optional<std::uint64_t> vf_listed, vf_true, ee_listed, ee_true, swept_vf, swept_ee;
};

/// Returns the facts about a step of `scene`; nothing if the file or `ccd` is missing. Throws as add_sequence_facts does.
std::optional<StepFacts> step_facts(const Scene& scene, const std::filesystem::path& meta);

}  // namespace bvhbench
