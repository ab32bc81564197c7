// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "collide/pairs.h"
#include "harness/choice/scene_choice.h"
#include "harness/record/output.h"
#include "scenes/scene.h"

namespace bvhbench {

/// Throws BadUsage unless `path` ends in .csv, or ends in .bin and `frames` is a single frame.
void check_pairs_path(const std::filesystem::path& path, const FrameRange& frames);

/// Writes the pairs of frames to a file, in canonical order, with the triangle and object numbers of the scene's file.
///
/// A .csv file has the header frame,object_a,object_b,a,b and one line per pair. For swept boxes, which belong to no object, the
/// header is frame,a,b and, with times of impact, frame,a,b,time. A .bin file holds one frame: two little-endian 32-bit ids per pair; its FNV-1a is the list's hash.
class PairsFile {
public:
    /// Writes nothing if `output` has no file. All functions throw what Output::Writer throws.
    PairsFile(const Output& output, bool is_swept, bool has_times = false);

    /// Appends a frame's pairs, with a time for each if the file has times. `scene` must be the same for all frames.
    void add(const PairList& pairs, std::size_t frame, const Scene& scene,
             std::span<const float> times = {});

    void finish();

private:
    std::string lines(std::span<const Pair> pairs, std::span<const float> times,
                      std::size_t frame) const;

    bool is_csv_, is_swept_, has_times_;
    /// Object of each triangle, by file numbers; empty until needed.
    std::vector<std::int64_t> objects_;
    std::optional<Output::Writer> writer_;
};

}  // namespace bvhbench
