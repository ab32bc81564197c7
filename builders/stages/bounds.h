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

/// The stage `bounds`: triangles to leaf boxes in mesh order, swept if the input is, and the bounds of each object's boxes.
/// One pass over all objects, or those chosen, however many there are.
class BoundsStage {
public:
    /// `group_size` 0: as the device is tuned.
    explicit BoundsStage(Programs& programs, KernelForm form = KernelForm::of_device,
                         uint group_size = 0);

    /// Take the buffers for objects of so many triangles each, none of them empty. The boxes are what `boxes` says, the rest
    /// is scratch. With `of_all`, the bounds of all objects together are made as well.
    void plan(Arena& arena, std::span<const uint> sizes, Use boxes, bool of_all = false);

    /// The same of one object.
    void plan(Arena& arena, std::size_t primitives, Use boxes);

    /// Write down what `enqueue` expects and leaves as it was. Waits.
    void prepare(const cl::CommandQueue& queue);

    /// Enqueue for an input of objects as planned, as a stage called so. Does not wait.
    void enqueue(const Input& input, Queue& queue, std::string_view stage = "bounds");

    /// The boxes of chosen objects of several, and the bounds of those that are lined up. All others stay.
    void enqueue(const Input& input, const ObjectRuns& chosen, Queue& queue);

    const Buffer<Aabb>& boxes() const { return boxes_; }      ///< one a triangle, in mesh order
    const Buffer<Bounds>& bounds() const { return bounds_; }  ///< one an object
    /// Of all objects, each as it was when it was lined up last; of several only if planned.
    const Buffer<Bounds>& bounds_of_all() const { return is_forest() ? bounds_of_all_ : bounds_; }

private:
    bool is_forest() const { return bounds_.size() > 1; }
    bool by_groups() const { return form_ == KernelForm::groups; }
    cl::Kernel kernel(const char* of_groups, const char* of_chunks, unsigned is_swept) const;
    template <class... Arguments>
    cl::Kernel& boxes_kernel(const Input& input, const Arguments&... more);
    void enqueue_one(const Input& input, Queue& queue);
    void enqueue_chosen(const Input& input, const ObjectRuns& chosen, Queue& queue);

    Programs& programs_;
    KernelForm form_;
    uint group_size_;   ///< for one object; runs of several have their own
    bool groups_meet_;  ///< the last one joins what all have found
    std::size_t most_partials_;
    ObjectRuns all_;
    cl::Kernel of_frame_, join_kernel_;
    std::optional<cl::Kernel> swept_;  ///< compiled when an input first asks for it
    Buffer<Aabb> boxes_;
    Buffer<Bounds> partials_;  ///< one a group, work-item or run
    Buffer<Bounds> bounds_;
    Buffer<uint> arrivals_;  ///< of groups that are done; 0 between launches
    Buffer<Bounds> bounds_of_all_;
    Buffer<uint> all_objects_;  ///< from 0 to their number, as a run of `bounds_`
    Buffer<uint> one_;          ///< the one place in `bounds_of_all_`
};

/// The same on the host: the bounds of `boxes`.
Bounds host_bounds(std::span<const Aabb> boxes);

}  // namespace bvhbench
