// SPDX-License-Identifier: MIT
//
// What colliders share that find all pairs in one launch, each leaf or each task's neighbouring leaves a walk of its
// own: one says which kernel that is.
#pragma once

#include "collide/device_collider.h"
#include "collide/parameters.h"
#include "collide/walks/task.h"

namespace bvhbench {

class WalkCollider : public DeviceCollider {
protected:
    /// Pairs that a work-item of the form for few cores collects before it passes them on.
    uint block_pairs() const { return device().tuned(walk_block_pairs); }

    /// `group_size` is what the device chooses if options do not.
    WalkCollider(Programs& programs, const ColliderCard& card, const ColliderOptions& options,
                 const Parameter& group_size);

    /// How a launch is cut into tasks.
    struct Shape {
        uint task_leaves;  ///< neighbouring leaves of a task, at most; a power of two
        std::size_t
            items_a_task;  ///< work-items that do a task; 0: a few work-items share all tasks
        std::size_t group_size;
    };

    /// Of the form that the collider has: a group a task, or a run of tasks a work-item.
    virtual Shape shape() const;

    /// The kernel that finds the pairs of tasks.
    virtual cl::Kernel walk_kernel(const DeviceTree& tree) const = 0;

    /// Of the form for few cores, one that several colliders use: without blocks, with a counter of tasks (TASKS_BEGUN).
    cl::Kernel lined_up_kernel(const DeviceTree& tree) const;

    /// Whether its work-items of the form for few cores collect pairs in blocks, which the kernel then takes last.
    virtual bool has_blocks() const { return true; }

private:
    void compile(const DeviceTree& tree) final;
    void plan(Arena& arena, const DeviceTree& tree) final;
    void prepare(const DeviceTree& tree, const cl::CommandQueue& queue) final;
    bool make_room(std::uint64_t tasks, const std::vector<std::uint64_t>& queue_sizes) final;
    void enqueue(const DeviceTree& tree, const Input& input, Queue& queue) final;
    void find_between(const DeviceTree& tree, Queue& queue);

    cl::Kernel walk_, between_kernel_;
    std::vector<QueryTask> own_list_;  ///< neighbouring leaves of each object, against its own tree
    std::size_t most_between_ = 0;     ///< tasks between objects that there is room for
    Buffer<QueryTask> own_;
    Buffer<QueryTask> between_;
    Buffer<Pair> blocks_;
};

}  // namespace bvhbench
