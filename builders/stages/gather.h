// SPDX-License-Identifier: MIT
#pragma once

#include "builders/stages/object_runs.h"
#include "device/buffer.h"
#include "device/program.h"
#include "device/queue.h"
#include "geometry/aabb.h"

namespace bvhbench {

/// The stage `gather`: boxes in the order of ids, at any place of an array. Owns no memory.
class GatherStage {
public:
    /// `group_size` 0: as the device is tuned.
    explicit GatherStage(Programs& programs, KernelForm form = KernelForm::of_device,
                         uint group_size = 0);

    /// Enqueue sorted[first + k] = boxes[ids[k]] for every id. Other elements of `sorted` stay. Does not wait.
    void enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids, const Buffer<Aabb>& sorted,
                 uint first, Queue& queue);

    /// The same of several objects: sorted[slots[owner of ids[k]] + k], modulo 2^32, = boxes[ids[k]].
    void enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids, const Buffer<uint>& owners,
                 const Buffer<uint>& slots, const Buffer<Aabb>& sorted, Queue& queue);

    /// The same of the objects that `runs`, cut for this form and group size, are of.
    void enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids, const ObjectRuns& runs,
                 const Buffer<uint>& slots, const Buffer<Aabb>& sorted, Queue& queue);

private:
    void launch(cl::Kernel& kernel, std::size_t count, std::size_t more_bytes, Queue& queue);

    KernelForm form_;
    uint group_size_;
    std::size_t chunks_;
    cl::Kernel kernel_, objects_kernel_, runs_kernel_;
};

}  // namespace bvhbench
