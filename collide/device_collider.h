// SPDX-License-Identifier: MIT
//
// What colliders share that query trees on the device: the frame's tree, its kernels, ropes.
#pragma once

#include "builders/device_tree.h"
#include "collide/pair_collider.h"
#include "collide/skips.h"

namespace bvhbench {

/// Objects that a work-item holds one against, where it looks for pairs of objects (between.cl, roots.cl).
inline constexpr uint others_a_work_item = 16;

class DeviceCollider : public PairCollider {
public:
    /// Throws BadUsage for a group size that the device does not have.
    DeviceCollider(Programs& programs, const ColliderCard& card, const ColliderOptions& options,
                   const Parameter& group_size);

    std::string refusal(const Tree& tree) const override;
    void reserve(const Tree* tree, const Input& input) final;
    void query(const Tree* tree, const Input& input, Queue& queue) final;
    QueryCounts counts(const Queue& queue) const override;

protected:
    /// Take what else is needed for trees like this one: kernels, and buffers. Run twice, first measuring.
    virtual void compile(const DeviceTree& tree) = 0;
    virtual void plan(Arena& arena, const DeviceTree& tree) = 0;

    /// Launch what finds the pairs, in the stage `broad`; counters are zero.
    virtual void enqueue(const DeviceTree& tree, const Input& input, Queue& queue) = 0;

    /// Bytes that `broad` must read: of a tree held against itself each box, and each leaf's triangle, once.
    virtual std::int64_t reads_at_least(const DeviceTree& tree) const;

    /// Whether it walks without a stack, and so wants ropes of trees that have no arithmetic for them.
    virtual bool needs_ropes() const { return true; }

    /// Queues between launches that counters are wanted for.
    virtual uint queue_count(const DeviceTree&) const { return 0; }

    /// Copy what must outlive the memory that goes when there is to be more. Waits.
    virtual void set_aside(const cl::CommandQueue&) {}

    /// Write down what queries expect and leave as it was, whenever memory was taken. Waits.
    virtual void prepare(const DeviceTree&, const cl::CommandQueue&) {}

    /// Compiled behind the tree's access header, with `more` besides the defines that all have.
    cl::Kernel kernel(const DeviceTree& tree, std::string_view path, const char* name,
                      std::vector<Define> more, Optimise optimise = Optimise::freely) const;

    /// Set the arguments that all have, the tree's first; `more` come behind.
    template <class... Arguments>
    void bind(cl::Kernel& kernel, const DeviceTree& tree, const Input& input,
              const Arguments&... more) const
    {
        set_arguments_from(kernel, tree.bind(kernel, 0), ropes_, input.device_faces, pairs_,
                           static_cast<uint>(pairs_.size()), counters_, more...);
    }

    bool skips(SkipRule rule) const { return (options_.rules_off & rule) == 0; }
    bool within() const { return options_.among != Among::between_objects; }
    bool between(const DeviceTree& tree) const
    {
        return options_.among != Among::within_objects && tree.objects.size() > 1;
    }

private:
    bool has_ropes(const DeviceTree& tree) const { return needs_ropes() && !tree.is_implicit(); }
    void plan_rest(Arena& arena) final;
    void write_down(const cl::CommandQueue& queue) final { prepare(*tree_, queue); }
    void save(const cl::CommandQueue& queue) final { set_aside(queue); }
    uint wide_counters() const final { return queue_count(*tree_); }
    void enqueue_ropes(const DeviceTree& tree, Queue& queue);

    const DeviceTree* tree_ = nullptr;  ///< that there is memory for
    cl::Kernel ropes_kernel_;
    Buffer<uint> ropes_;  ///< one a node; one word where there are none
};

}  // namespace bvhbench
