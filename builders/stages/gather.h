// SPDX-License-Identifier: MIT
#pragma once

#include "builders/box_format.h"
#include "builders/stages/object_runs.h"
#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"
#include "geometry/scene_bounds.h"

namespace bvhbench {

/// Where boxes in leaf order go.
struct GatherPlace {
    Buffer<std::byte> boxes;  ///< in the format that trees keep theirs in
    uint first = 0;           ///< leaf k of all goes there and k further
    /// If not empty, leaf k of an object goes to the object's slot here and k further, modulo 2^32: k counts all leaves.
    Buffer<uint> slots = {};
};

/// The stage `gather`: boxes in the order of ids, at any place of an array, in the format that trees keep theirs in.
class GatherStage {
public:
    /// `group_size` 0: as the device is tuned. Throws Unavailable where a format needs doubles that the device lacks.
    explicit GatherStage(Programs& programs, KernelForm form = KernelForm::of_device,
                         uint group_size = 0, const BoxFormat& format = float_boxes());

    /// Boxes will go to `place`. Takes what a format other than floats needs: scenes have these bounds, one an object, by the
    /// time their boxes are gathered.
    void plan(Arena& arena, const GatherPlace& place, const Buffer<Bounds>& bounds = {});

    /// One: of the scene gathered last; of formats with cells.
    const Buffer<SceneCells>& cells() const { return cells_; }

    /// Enqueue: the box of every id goes to its place. Whose triangles are, `owners` says if there are slots. Does not wait.
    void enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids, const Buffer<uint>& owners,
                 Queue& queue);

    /// The same of the objects that `runs`, cut for this form, are of, of several; not of formats with cells, which are those
    /// of all objects.
    void enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids, const ObjectRuns& runs,
                 Queue& queue);

private:
    template <class... Arguments>
    void bind(cl::Kernel& kernel, const Arguments&... arguments) const;
    void find_cells(Queue& queue);
    std::int64_t moved_bytes(std::size_t count) const;

    Programs& programs_;
    KernelForm form_;
    uint group_size_;
    std::size_t chunks_;
    const BoxFormat& format_;
    GatherPlace place_;
    cl::Kernel kernel_, runs_kernel_, cells_kernel_;
    Buffer<Bounds> bounds_;
    Buffer<SceneCells> cells_;  ///< one, of others than floats
};

}  // namespace bvhbench
