// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "builders/input.h"
#include "builders/stages/kernel_form.h"
#include "builders/stages/object_runs.h"
#include "device/arena.h"
#include "device/program.h"
#include "geometry/scene_bounds.h"

namespace bvhbench {

/// Stage `bounds`: computes the leaf boxes of triangles in mesh order, swept if the input is, and the bounds of each object's
/// boxes. One pass serves all objects, or a chosen subset, however many there are.
class BoundsStage {
public:
    /// `group_size` 0: the device's tuned value.
    explicit BoundsStage(Programs& programs, KernelForm form = KernelForm::of_device,
                         uint group_size = 0);

    /// Takes the buffers for objects of `sizes` triangles, each at least 1. Boxes are counted as `boxes`, everything else as
    /// scratch. With `of_all`, the stage also computes the bounds of all objects together.
    void plan(Arena& arena, std::span<const uint> sizes, Use boxes, bool of_all = false);

    /// Takes the buffers for one object, or for all triangles of several as if they were one.
    void plan(Arena& arena, std::size_t primitives, Use boxes);

    /// Uploads the constant inputs of `enqueue`. Blocks until done.
    void prepare(const cl::CommandQueue& queue);

    /// Enqueues the pass over all objects as a stage named `stage`. Several objects keep their bounds unless it `joins` them, too.
    /// Does not block.
    void enqueue(const Input& input, Queue& queue, std::string_view stage = "bounds",
                 bool joins = true);

    /// Enqueues the boxes of the chosen objects and the bounds of those that are reordered. Other objects keep theirs.
    void enqueue(const Input& input, const ObjectRuns& chosen, Queue& queue);

    const Buffer<Aabb>& boxes() const { return boxes_; }      ///< One per triangle, in mesh order.
    const Buffer<Bounds>& bounds() const { return bounds_; }  ///< One per planned object.
    /// Bounds of all objects together, each as of its last reordering. With several objects, only if planned.
    const Buffer<Bounds>& bounds_of_all() const { return is_forest() ? bounds_of_all_ : bounds_; }

private:
    bool is_forest() const { return bounds_.size() > 1; }
    bool by_groups() const { return form_ == KernelForm::groups; }
    cl::Kernel kernel(const char* of_groups, const char* of_chunks, unsigned is_swept) const;
    template <class... Arguments>
    cl::Kernel& boxes_kernel(const Input& input, const Arguments&... more);
    void enqueue_one(const Input& input, Queue& queue);
    void enqueue_chosen(const Input& input, const ObjectRuns& chosen, bool joins, Queue& queue);

    Programs& programs_;
    KernelForm form_;
    uint group_size_;   ///< For one object; runs of several objects have their own group size.
    bool groups_meet_;  ///< True if the last group to finish joins the partial bounds.
    std::size_t most_partials_;
    ObjectRuns all_;
    cl::Kernel of_frame_, join_kernel_;
    std::optional<cl::Kernel> swept_;  ///< Compiled at the first swept input.
    Buffer<Aabb> boxes_;
    Buffer<Bounds> partials_;  ///< One per group, work-item or run.
    Buffer<Bounds> bounds_;
    Buffer<uint> arrivals_;  ///< Number of finished groups; 0 between launches.
    Buffer<Bounds> bounds_of_all_;
    Buffer<uint> all_objects_;  ///< The range 0 to the number of objects, as one run of `bounds_`.
    Buffer<uint> one_;          ///< Index of the only element of `bounds_of_all_`.
};

/// Returns the bounds of `boxes`, computed on the host.
Bounds host_bounds(std::span<const Aabb> boxes);

}  // namespace bvhbench
