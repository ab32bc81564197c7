// SPDX-License-Identifier: MIT
#pragma once

#include "builders/box_format.h"
#include "builders/stages/object_runs.h"
#include "device/arena.h"
#include "device/program.h"
#include "device/queue.h"
#include "geometry/scene_bounds.h"

namespace bvhbench {

/// Destination of boxes in leaf order.
struct GatherPlace {
    Buffer<std::byte> boxes;  ///< In the tree's format.
    uint first = 0;           ///< Leaf 0 goes to index `first`, leaf k to first + k.
    /// If not empty, leaf k of object o goes to index slots[o] + k, modulo 2^32; k counts the leaves of all objects.
    Buffer<uint> slots = {};
};

/// Stage `gather`: copies boxes into the order of ids, anywhere in an array, in the tree's format.
class GatherStage {
public:
    /// `group_size` 0: the device's tuned value. Throws Unavailable if the format needs doubles and the device has none.
    explicit GatherStage(Programs& programs, KernelForm form = KernelForm::of_device,
                         uint group_size = 0, const BoxFormat& format = float_boxes());

    /// Sets the destination to `place` and takes the memory that formats other than floats need. `bounds` has one element per
    /// object and must be computed before boxes are gathered.
    void plan(Arena& arena, const GatherPlace& place, const Buffer<Bounds>& bounds = {});

    /// One element: the cells of the scene gathered last, in formats with cells.
    const Buffer<SceneCells>& cells() const { return cells_; }

    /// Enqueues the copy of all boxes. `owners` holds the object of each triangle; it is read only if there are slots. Does not
    /// block.
    void enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids, const Buffer<uint>& owners,
                 Queue& queue);

    /// Enqueues the copy for the objects of `runs` only, of several objects; `runs` must have this stage's kernel form. Not
    /// allowed in formats with cells, which depend on all objects.
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
    Buffer<SceneCells> cells_;  ///< One element, unless boxes are floats.
};

}  // namespace bvhbench
