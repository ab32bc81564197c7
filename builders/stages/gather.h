// SPDX-License-Identifier: MIT
#pragma once

#include "builders/box_format.h"
#include "builders/stages/object_runs.h"
#include "device/buffer.h"
#include "device/program.h"
#include "device/queue.h"
#include "geometry/bounds.h"

namespace bvhbench {

/// The stage `gather`: boxes in the order of ids, at any place of an array, in the format that trees keep theirs in.
class GatherStage {
public:
    /// `group_size` 0: as the device is tuned. Throws Unavailable where a format needs doubles that the device lacks.
    explicit GatherStage(Programs& programs, KernelForm form = KernelForm::of_device,
                         uint group_size = 0, const BoxFormat& format = float_boxes());

    /// Take what a format other than floats needs. Scenes have these bounds, one an object, by the time their boxes are
    /// gathered.
    void plan(Arena& arena, const Buffer<Bounds>& bounds);

    const Buffer<SceneCells>& cells() const
    {
        return cells_;
    }  ///< one: of the scene gathered last; of formats with cells

    /// Enqueue sorted[first + k] = boxes[ids[k]] for every id. Other elements of `sorted` stay. Does not wait.
    void enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids,
                 const Buffer<std::byte>& sorted, uint first, Queue& queue);

    /// The same of several objects: sorted[slots[owner of ids[k]] + k], modulo 2^32, = boxes[ids[k]].
    void enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids, const Buffer<uint>& owners,
                 const Buffer<uint>& slots, const Buffer<std::byte>& sorted, Queue& queue);

    /// The same of the objects that `runs`, cut for this form and group size, are of; not of formats with cells, which
    /// are those of all objects.
    void enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids, const ObjectRuns& runs,
                 const Buffer<uint>& slots, const Buffer<std::byte>& sorted, Queue& queue);

private:
    template <class... Arguments>
    void bind(cl::Kernel& kernel, const Arguments&... arguments) const;
    void find_cells(Queue& queue);
    void launch(cl::Kernel& kernel, std::size_t count, std::size_t more_bytes, Queue& queue);
    std::int64_t moved_bytes(std::size_t count) const;

    KernelForm form_;
    uint group_size_;
    std::size_t chunks_;
    const BoxFormat& format_;
    cl::Kernel kernel_, objects_kernel_, runs_kernel_, cells_kernel_;
    Buffer<Bounds> bounds_;
    Buffer<SceneCells> cells_;  ///< one, of others than floats
};

}  // namespace bvhbench
