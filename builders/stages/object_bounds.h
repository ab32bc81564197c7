// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string_view>

#include "builders/input.h"
#include "builders/stages/kernel_form.h"
#include "device/arena.h"
#include "device/program.h"
#include "geometry/bounds.h"

namespace bvhbench {

/// The stage `bounds` over several objects: leaf boxes in mesh order, and the bounds of each object's, in one pass
/// over all objects, however many there are.
class ObjectBounds {
public:
    explicit ObjectBounds(Programs& programs, KernelForm form = KernelForm::of_device,
                          uint group_size = 256);

    /// Take the buffers for objects of so many triangles each, none of them empty.
    void plan(Arena& arena, std::span<const uint> sizes, Use boxes);

    /// Write down which triangles are whose. Waits.
    void prepare(const cl::CommandQueue& queue);

    /// Enqueue for an input of objects as planned, as a stage called so. Does not wait.
    void enqueue(const Input& input, Queue& queue, std::string_view stage = "bounds");

    const Buffer<Aabb>& boxes() const { return boxes_; }      ///< one a triangle, in mesh order
    const Buffer<Bounds>& bounds() const { return bounds_; }  ///< one an object

private:
    /// Neighbouring triangles of one object, which a group or a work-item reads.
    struct Run {
        uint first = 0, end = 0;
    };

    KernelForm form_;
    uint group_size_;
    std::size_t chunks_;
    cl::Kernel boxes_kernel_, join_kernel_;
    std::vector<Run> run_list_;
    std::vector<uint> first_run_list_;
    Buffer<Aabb> boxes_;
    Buffer<Run> runs_;
    Buffer<uint> first_runs_;  ///< of each object, and behind the last one's end
    Buffer<Bounds> partials_;  ///< one a run
    Buffer<Bounds> bounds_;
};

}  // namespace bvhbench
