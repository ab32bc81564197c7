// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "scenes/scene.h"

namespace bvhbench {

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
