// SPDX-License-Identifier: MIT
//
// The rule `near` (skips.h) on the device: the triangles of a frame that can be in a pair between two objects.
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
    /// Objects that an object is held against by a list of its own; against more, all are tested. Never wrong.
    unsigned listed = 256;
};

/// Finds the triangles whose box touches the box of another object, and puts them together as a frame of their own.
///
/// Two triangles of two objects that overlap are both near: each touches the other's object. So that frame has all
/// pairs between objects. A triangle may be near without being in any pair.
class NearTriangles {
public:
    NearTriangles(Programs& programs, const NearOptions& options);

    /// With more near triangles than this, the whole frame is used.
    static std::size_t most_of(std::size_t triangles) { return triangles / 2; }

    /// Whether the search may be worth its time on so many triangles. A GPU builds over a million of them sooner than it
    /// makes the search's launches and the host reads what it found; a processor's launches cost nothing beside.
    static bool may_pay(const Device& device, std::size_t triangles)
    {
        return device.is_cpu() || triangles >= std::size_t{1} << 22;
    }

    /// Take memory for frames like this one: the same faces and objects, other points. Never timed. Waits.
    void reserve(const Input& input);

    /// What stands reserved.
    Footprint reserved() const { return arena_ ? arena_->used() : Footprint{}; }

    /// Find and gather them, in the stage `near`, whose last command reads back how many each object has. Waits for it.
    std::vector<uint> find(const Input& input, Queue& queue);

    /// The frame of what was found, most_of at most, and the objects that have some. Shares memory with this, so that
    /// another `find` fills it again, and with `whole`, which is not swept; `faces` is where its copy on the host goes. Waits.
    Input frame(const Input& whole, const std::vector<uint>& counts, std::vector<Face>& faces,
                const Queue& queue) const;

    /// Enqueue, as part of the stage begun, what gives the triangles of that frame's pairs the whole frame's numbers.
    void map_back(const DevicePairs& found, Queue& queue);

    /// Boxes that the last `find` has tested for overlap. Waits.
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
    Buffer<uint> lists_, list_sizes_;  ///< of each object, the others that its box touches
    Buffer<uint> places_;  ///< of each triangle and behind the last, how many before it are near
    Buffer<uint> first_faces_;     ///< of each object, and behind the last one's end
    Buffer<uint> counts_, ranks_;  ///< of each object
    Buffer<uint> test_count_;      ///< of two words
    Buffer<Face> faces_;           ///< of the frame, as owners_ and ids_
    Buffer<uint> owners_;
    Buffer<uint> ids_;  ///< which triangles of the whole frame they are
};

}  // namespace bvhbench
