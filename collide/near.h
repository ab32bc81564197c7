// SPDX-License-Identifier: MIT
//
// Device part of the rule `near` (skips.h): finds the triangles of a frame that can be in a pair between two objects.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "builders/input.h"
#include "builders/stages/bounds.h"
#include "builders/stages/scan.h"
#include "collide/collider.h"

namespace bvhbench {

struct NearOptions {
    KernelForm form = KernelForm::of_device;
    /// Capacity of an object's list of overlapping objects. If it overlaps more, all are tested, with the same result.
    unsigned listed = 256;
};

/// Finds the triangles whose box overlaps the box of another object, and gathers them as a frame of their own.
///
/// If two triangles of two objects overlap, each overlaps the box of the other object, so both are gathered and that frame
/// contains all pairs between objects. A gathered triangle need not be in any pair.
class NearTriangles {
public:
    NearTriangles(Programs& programs, const NearOptions& options);

    /// Largest number of near triangles that is used; with more, the whole frame is used.
    static std::size_t most_of(std::size_t triangles) { return triangles / 2; }

    /// Most objects that are tested each against each for their lists. With more, the rule is not used.
    static constexpr std::size_t most_objects = 4096;

    /// Reserves memory for frames like `input`: same faces and objects, any points. Never timed. Blocks.
    void reserve(const Input& input);

    /// Memory reserved at present.
    Footprint reserved() const { return arena_ ? arena_->used() : Footprint{}; }

    /// Finds and gathers the near triangles in the stage `near`; returns their number per object. Blocks on the final read.
    std::vector<uint> find(const Input& input, Queue& queue);

    /// Returns the frame of the near triangles (at most most_of), with the objects that have any. Its
    /// buffers belong to this object, and the next `find` overwrites them; the points are those of `whole`, which must not be
    /// swept. `faces` receives the host copy of the faces. Blocks.
    Input frame(const Input& whole, const std::vector<uint>& counts, std::vector<Face>& faces,
                const Queue& queue) const;

    /// Enqueues, in the current stage, the conversion of pairs of that frame to triangle ids of the whole frame.
    void map_back(const DevicePairs& found, Queue& queue);

    /// Box tests of the last `find`. Blocks.
    std::uint64_t box_tests(const Queue& queue) const;

private:
    void plan(Arena& arena, const Input& input);
    void launch(cl::Kernel& kernel, std::size_t items, std::int64_t moved_bytes, Queue& queue);

    Programs& programs_;
    NearOptions options_;
    KernelForm form_;
    std::size_t chunks_;
    BoundsStage bounds_;
    ScanStage scan_places_, scan_ranks_;
    cl::Kernel list_, flag_, count_, compact_, map_;
    std::optional<Arena> arena_;
    Buffer<uint> lists_, list_sizes_;  ///< per object: objects that its box overlaps
    Buffer<uint> places_;              ///< near triangles before each triangle, and in all
    Buffer<uint> first_faces_;         ///< first triangle of each object; then the triangle count
    Buffer<uint> counts_, ranks_;      ///< per object
    Buffer<uint> test_count_;          ///< one 64-bit count
    Buffer<Face> faces_;               ///< near triangles, as are owners_ and ids_
    Buffer<uint> owners_;
    Buffer<uint> ids_;  ///< their ids in the whole frame
};

}  // namespace bvhbench
