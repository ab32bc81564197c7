// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "builders/device_tree.h"
#include "builders/input.h"
#include "builders/stages/kernel_form.h"
#include "collide/object_filter.h"
#include "device/arena.h"
#include "device/program.h"

namespace bvhbench {

class RadixSort;

/// The order in which the boxes of objects begin along one axis. A query tests an object against those near it in this order instead
/// of against all (the rule `apart`; object_order.clh). A filter is applied there as well, to objects whose boxes overlap.
class ObjectOrder {
public:
    /// Objects from which on the order is made. On two cores a frame of 600 objects takes 0.5 to 0.8 of its time with it (`leaf`,
    /// `group`). On an H200 one of 1,000 takes 10 to 25 µs more, of 2,500 the same or 40 less, and of 20,000 0.7 of the time (`block`)
    /// or 0.04 (`bvtt`).
    static constexpr std::size_t least_objects(KernelForm form)
    {
        return form == KernelForm::groups ? 2048 : 512;
    }

    /// Work-items that share a sweep in the group form: the longest sweep decides, and by one work-item each,
    /// 5,000 objects took 0.2 ms longer on an H200.
    static constexpr uint lanes = 32;

    /// `begin` and `place` are kernels of object_order.cl for the tree. The axis is that along which the objects of `input` are
    /// shortest, compared with the scene. It is right for any frame, and good for those alike. Without host points it is the first.
    /// `tables` are of all objects, or empty if none is filtered.
    ObjectOrder(Programs& programs, KernelForm form, cl::Kernel begin, cl::Kernel place,
                const Input& input, FilterTables tables);

    ~ObjectOrder();

    /// Takes all memory.
    void plan(Arena& arena, const DeviceTree& tree);

    /// Uploads what the sort and the filter need. Waits.
    void prepare(const cl::CommandQueue& queue);

    /// Enqueues the order of the tree's objects in the current stage. Does not block.
    void enqueue(const DeviceTree& tree, Queue& queue);

    /// Sets the arguments ORDER_PARAMETERS of a kernel from `index` on, then `more`. The kernel is FILTERED if there are tables.
    template <class... Arguments>
    void bind(cl::Kernel& kernel, cl_uint index, const Arguments&... more) const
    {
        if (tables_.rules.empty())
            set_arguments_from(kernel, index, objects_, axis_, lined_up_, ranks_, boxes_, more...);
        else
            set_arguments_from(kernel, index, objects_, axis_, lined_up_, ranks_, boxes_, rules_,
                               excluded_, more...);
    }

private:
    uint objects_ = 0, axis_;
    std::unique_ptr<RadixSort> sort_;
    cl::Kernel begin_, place_;
    Buffer<uint> lined_up_, ranks_;
    Buffer<std::byte> boxes_;
    FilterTables tables_;
    Buffer<FilterRule> rules_;
    Buffer<uint> excluded_;
};

}  // namespace bvhbench
