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
/// A .csv file has the header frame,object_a,object_b,a,b and one line per pair. For features, which belong to no object, the
/// header is frame,a,b and, with times of impact, frame,a,b,time. With distances, distance,ax,ay,az,bx,by,bz follow: those of
/// closest_points. A .bin file holds one frame: two little-endian 32-bit ids per pair; its FNV-1a is the list's hash.
class PairsFile {
public:
    /// What a line has of a pair beside its numbers.
    enum class With { nothing, times, distances };

    /// Writes nothing if `output` has no file. All functions throw what Output::Writer throws.
    PairsFile(const Output& output, bool of_features, With with = With::nothing);

    /// Appends a frame's pairs, with a time for each if the file has times. `scene` has the frame; pairs are of `features`, the same in
    /// all frames, if there are any, else of triangles.
    void add(const PairList& pairs, std::size_t frame, const Scene& scene,
             std::span<const float> times = {}, std::span<const Face> features = {});

    void finish();

private:
    std::string lines(std::span<const Pair> pairs, std::span<const float> times,
                      std::span<const Point> points, std::size_t frame) const;

    bool is_csv_, of_features_;
    With with_;
    const Scene* scene_ = nullptr;       ///< of the last frame
    std::vector<std::int64_t> objects_;  ///< of each triangle, by file numbers
    std::vector<Face> faces_;  ///< what pairs are of, by file numbers, if distances are written
    std::optional<Output::Writer> writer_;
};

}  // namespace bvhbench
