// SPDX-License-Identifier: MIT
//
// What colliders on the device share: memory, counters, ropes, room for pairs and making more of it.
#pragma once

#include <optional>

#include "builders/device_tree.h"
#include "collide/collider.h"
#include "collide/skips.h"

namespace bvhbench {

class DeviceCollider : public Collider {
public:
    /// Throws BadUsage for a group size that the device does not have.
    DeviceCollider(Programs& programs, const ColliderCard& card, const ColliderOptions& options,
                   unsigned usual_group_size);

    ColliderCard card() const final { return card_; }
    std::string refusal(const Tree& tree) const override;
    void reserve(const Tree* tree, const Input& input) final;
    Footprint reserved() const final { return arena_ ? arena_->used() : Footprint{}; }
    void query(const Tree* tree, const Input& input, Queue& queue) final;
    bool complete(const Queue& queue) final;
    QueryCounts counts(const Queue& queue) const override;
    std::vector<Pair> pairs(const Queue& queue) const final;
    DevicePairs device_pairs(Queue&) final { return {pairs_, counters_}; }


protected:
    /// Take what else is needed for trees like this one: kernels, and buffers. Run twice, first measuring.
    virtual void compile(const DeviceTree& tree) = 0;
    virtual void plan(Arena& arena, const DeviceTree& tree) = 0;

    /// Launch what finds the pairs, in the stage `broad`; counters are zero.
    virtual void enqueue(const DeviceTree& tree, const Input& input, Queue& queue) = 0;

    /// Whether it walks without a stack, and so wants ropes of trees that have no arithmetic for them.
    virtual bool needs_ropes() const { return true; }

    /// Queues between launches that counters are wanted for, and how to make room for so many tasks and entries.
    virtual uint queue_count(const DeviceTree&) const { return 0; }
    virtual bool make_room(std::uint64_t tasks, const std::vector<std::uint64_t>& queue_sizes) = 0;

    /// Copy what must outlive the memory that goes when there is to be more. Waits.
    virtual void set_aside(const cl::CommandQueue&) {}

    /// Write down what queries expect and leave as it was, whenever memory was taken. Waits.
    virtual void prepare(const DeviceTree&, const cl::CommandQueue&) {}

    /// Compiled behind the tree's access header, with `more` besides the defines that all have.
    cl::Kernel kernel(const DeviceTree& tree, std::string_view path, const char* name,
                      std::vector<Define> more) const;

    /// Set the arguments that all have, the tree's first; `more` come behind.
    template <class... Arguments>
    void bind(cl::Kernel& kernel, const DeviceTree& tree, const Input& input,
              const Arguments&... more) const
    {
        set_arguments_from(kernel, tree.bind(kernel, 0), ropes_, input.device_faces, pairs_,
                           static_cast<uint>(pairs_.size()), counters_, more...);
    }

    bool by_groups() const { return form_ == KernelForm::groups; }
    bool skips(SkipRule rule) const { return (options_.rules_off & rule) == 0; }
    bool within() const { return options_.among != Among::between_objects; }
    bool between(const DeviceTree& tree) const
    {
        return options_.among != Among::within_objects && tree.objects.size() > 1;
    }
    const Device& device() const { return programs_.device(); }

    std::vector<std::uint64_t> counters(const Queue& queue) const;

    ColliderOptions options_;
    uint group_size_;
    std::size_t chunks_;     ///< work-items of the form for few cores
    Buffer<uint> counters_;  ///< as collide/counters.h says

private:
    bool has_ropes(const DeviceTree& tree) const { return needs_ropes() && !tree.is_implicit(); }
    void take_all(Arena& arena);
    void take_memory();
    void enqueue_ropes(const DeviceTree& tree, Queue& queue);

    Programs& programs_;
    ColliderCard card_;
    KernelForm form_;
    const DeviceTree* tree_ = nullptr;  ///< that there is memory for
    std::size_t capacity_ = 0;          ///< pairs there is room for
    std::optional<Arena> arena_;
    cl::Kernel ropes_kernel_;
    Buffer<uint> ropes_;     ///< one a node; one word where there are none
    Buffer<Pair> pairs_;  ///< found, in no order
};

}  // namespace bvhbench
