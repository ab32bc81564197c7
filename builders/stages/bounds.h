// SPDX-License-Identifier: MIT
#pragma once

#include "builders/input.h"
#include "builders/stages/box_kernels.h"
#include "builders/stages/kernel_form.h"
#include "device/arena.h"
#include "device/program.h"
#include "geometry/bounds.h"

namespace bvhbench {

/// The stage `bounds`: triangles to leaf boxes in mesh order, swept if the input is, and the bounds of them all, in one pass.
class BoundsStage {
public:
    /// `group_size` 0: as the device is tuned.
    explicit BoundsStage(Programs& programs, KernelForm form = KernelForm::of_device,
                         uint group_size = 0);

    /// Take the buffers for `primitives` triangles. The boxes are what `boxes` says, the rest is scratch.
    void plan(Arena& arena, std::size_t primitives, Use boxes);

    /// Write down what `enqueue` expects and leaves as it was. Waits.
    void prepare(const cl::CommandQueue& queue);

    /// Enqueue for an input of as many triangles as planned, at least one. Does not wait.
    void enqueue(const Input& input, Queue& queue);

    const Buffer<Aabb>& boxes() const { return boxes_; }      ///< one a triangle, in mesh order
    const Buffer<Bounds>& bounds() const { return bounds_; }  ///< one

private:
    std::size_t partial_count(std::size_t primitives) const;

    KernelForm form_;
    uint group_size_;
    bool groups_meet_;  ///< the last one joins what all have found
    std::size_t most_partials_;
    BoxKernels boxes_kernel_;
    cl::Kernel join_kernel_;
    Buffer<Aabb> boxes_;
    Buffer<Bounds> partials_;
    Buffer<Bounds> bounds_;
    Buffer<uint> arrivals_;  ///< of groups that are done; 0 between launches
};

/// The same on the host: the bounds of `boxes`.
Bounds host_bounds(std::span<const Aabb> boxes);

}  // namespace bvhbench
