// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "collide/pairs.h"
#include "harness/choice/scene_choice.h"
#include "harness/record/output.h"
#include "scenes/scene.h"

namespace bvhbench {

/// Throws BadUsage unless `path` ends in .csv, or in .bin where `frames` is one frame.
void check_pairs_path(const std::filesystem::path& path, const FrameRange& frames);

/// A file of the pairs of frames, in canonical order, by the numbers that triangles and objects have in the scene's file.
///
/// .csv has the line frame,object_a,object_b,a,b and then a line a pair; of swept boxes, which belong to no object, it is
/// frame,a,b. .bin holds one frame: little-endian 32-bit ids, two a pair and nothing else, whose FNV-1a is the list's hash.
class PairsFile {
public:
    /// Writes nothing if `output` is nowhere. Throws as Output does; so do the others.
    PairsFile(const Output& output, bool is_swept);

    /// `scene` is the same for all frames.
    void add(const PairList& pairs, std::size_t frame, const Scene& scene);

    void finish();

private:
    std::string lines(std::span<const Pair> pairs, std::size_t frame) const;

    bool is_csv_, is_swept_;
    /// Of each triangle, by the file's numbers; empty: not asked for yet.
    std::vector<std::int64_t> objects_;
    std::optional<Output::Writer> writer_;
};

}  // namespace bvhbench
