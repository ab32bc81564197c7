// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "builders/input.h"
#include "builders/stages/box_kernels.h"
#include "builders/stages/object_runs.h"
#include "device/arena.h"
#include "device/program.h"
#include "geometry/bounds.h"

namespace bvhbench {

/// The stage `bounds` over several objects: leaf boxes in mesh order, swept if the input is, and the bounds of each
/// object's, in one pass over all objects, or those chosen, however many there are.
class ObjectBounds {
public:
    explicit ObjectBounds(Programs& programs, KernelForm form = KernelForm::of_device,
                          uint group_size = 256);

    /// Take the buffers for objects of so many triangles each, none of them empty. With `of_all`, the bounds of all
    /// objects together are made as well.
    void plan(Arena& arena, std::span<const uint> sizes, Use boxes, bool of_all = false);

    /// Write down which triangles are whose. Waits.
    void prepare(const cl::CommandQueue& queue);

    /// Enqueue for an input of objects as planned, as a stage called so. Does not wait.
    void enqueue(const Input& input, Queue& queue, std::string_view stage = "bounds")
    {
        queue.begin(stage);
        enqueue_chosen(input, all_, queue);
    }

    /// The boxes of chosen objects, and the bounds of those that are lined up. All others stay.
    void enqueue(const Input& input, const ObjectRuns& chosen, Queue& queue)
    {
        queue.begin("bounds");
        enqueue_chosen(input, chosen, queue);
    }

    const Buffer<Aabb>& boxes() const { return boxes_; }      ///< one a triangle, in mesh order
    const Buffer<Bounds>& bounds() const { return bounds_; }  ///< one an object
    /// Of all objects, each as it was when it was lined up last; empty unless planned.
    const Buffer<Bounds>& bounds_of_all() const { return bounds_of_all_; }

private:
    void enqueue_chosen(const Input& input, const ObjectRuns& chosen, Queue& queue);

    ObjectRuns all_;
    BoxKernels boxes_kernel_;
    cl::Kernel join_kernel_;
    Buffer<Aabb> boxes_;
    Buffer<Bounds> partials_;  ///< one a run
    Buffer<Bounds> bounds_;
    Buffer<Bounds> bounds_of_all_;
    Buffer<uint> all_objects_;  ///< from 0 to their number, as a run of `bounds_`
    Buffer<uint> one_;          ///< the one place in `bounds_of_all_`
};

}  // namespace bvhbench
