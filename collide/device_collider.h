// SPDX-License-Identifier: MIT
//
// What all colliders on the device share: the frame's tree, its kernels and ropes, memory, counters, and pairs with more
// room where there was too little.
//
//     reserve    compile, then with memory measured and taken: plan, fill
//     query      ropes, if any; counters are cleared; enqueue
//     complete   make_room; if anything found none, save, plan and fill over again
#pragma once

#include <optional>

#include "builders/device_tree.h"
#include "collide/collider.h"
#include "collide/skips.h"

namespace bvhbench {

class DeviceCollider : public Collider {
public:
    ColliderCard card() const final { return card_; }
    bool needs_tree() const final { return wants_ != Wants::no_tree; }
    std::string refusal(const Tree& tree) const final;
    void reserve(const Tree* tree, const Input& input) final;
    Footprint reserved() const final { return arena_ ? arena_->used() : Footprint{}; }
    void query(const Tree* tree, const Input& input, Queue& queue) final;
    bool complete(const Queue& queue) final;
    QueryCounts counts(const Queue& queue) const override;
    std::vector<Pair> pairs(const Queue& queue) const final;
    DevicePairs device_pairs(Queue&) final { return {pairs_, counters_}; }

protected:
    /// Whether it queries a tree, and walks it without a stack: then trees that have no arithmetic for that get ropes.
    enum class Wants { no_tree, tree, tree_with_ropes };

    /// `group_size` is what the device chooses if options do not. Throws BadUsage for one that the device does not have.
    DeviceCollider(Programs& programs, const ColliderCard& card, const ColliderOptions& options,
                   const Parameter& group_size, Wants wants);

    /// Why it cannot query this kind of tree, as a sentence; empty if it can.
    virtual std::string objection(const DeviceTree&) const { return {}; }

    /// Compile for frames like this one, and choose how large buffers are at first, and `queue_count_`.
    virtual void compile(const Input& input) = 0;

    /// Take buffers besides counters and pairs. Run twice, first measuring.
    virtual void plan(Arena& arena) = 0;

    /// Copy what must outlive the memory that goes; write what queries expect in the new, and leave as it was. Both wait.
    virtual void save(const cl::CommandQueue&) {}
    virtual void fill(const cl::CommandQueue&) {}

    /// Launch what comes before the stage `broad`, and what finds the pairs there; counters are zero. Neither is called
    /// where there can be no pair.
    virtual void enqueue_before(const Input&, Queue&) {}
    virtual void enqueue(const Input& input, Queue& queue) = 0;

    /// Whether so many tasks and entries of each queue had room; if not, `plan` takes more from here on.
    virtual bool make_room(std::uint64_t tasks, const std::vector<std::uint64_t>& queues) = 0;

    /// Bytes that `broad` must read: of a tree held against itself each box, and each leaf's triangle, once.
    virtual std::int64_t reads_at_least() const;

    /// A kernel over the tree, compiled behind its access header, with `more` besides the defines that all have.
    cl::Kernel kernel(std::string_view path, const char* name, std::vector<Define> more = {},
                      Optimise optimise = Optimise::freely) const;

    /// Set the arguments that all have, the tree's first; `more` come behind.
    template <class... Arguments>
    void bind(cl::Kernel& kernel, const Input& input, const Arguments&... more) const
    {
        set_arguments_from(kernel, tree().bind(kernel, 0), ropes_, input.device_faces, pairs_,
                           static_cast<uint>(pairs_.size()), counters_, more...);
    }

    /// Launch a work-item for each of `items`, in groups.
    static void launch(const cl::Kernel& kernel, std::size_t items, std::size_t group, Queue& queue,
                       std::int64_t moved_bytes = 0)
    {
        queue.launch(kernel, (items + group - 1) / group * group, group, moved_bytes);
    }

    const DeviceTree& tree() const { return *tree_; }
    uint object_count() const { return static_cast<uint>(tree_->objects.size()); }
    bool by_groups() const { return form_ == KernelForm::groups; }
    bool skips(SkipRule rule) const { return (options_.rules_off & rule) == 0; }
    bool within() const { return options_.among != Among::between_objects; }
    bool between(std::size_t objects) const
    {
        return options_.among != Among::within_objects && objects > 1;
    }
    Programs& programs() const { return programs_; }
    const Device& device() const { return programs_.device(); }

    /// Entries that a list begins with: as many as options say, else `guess`, as far as one allocation goes.
    std::size_t first_room(std::size_t guess, std::size_t entry_bytes = sizeof(Pair)) const
    {
        return options_.capacity != 0 ? options_.capacity : device().room_for(guess, entry_bytes);
    }

    ColliderOptions options_;
    uint group_size_;
    std::size_t chunks_;     ///< work-items of the form for few cores
    uint triangles_ = 0;     ///< that there is memory for
    uint queue_count_ = 0;   ///< counters of queues
    Buffer<uint> counters_;  ///< as collide/counters.h says
    Buffer<Pair> pairs_;     ///< found, in no order

private:
    bool has_ropes(const DeviceTree& tree) const
    {
        return wants_ == Wants::tree_with_ropes && !tree.is_implicit();
    }
    void take_all();

    Programs& programs_;
    ColliderCard card_;
    Wants wants_;
    KernelForm form_;
    const DeviceTree* tree_ = nullptr;  ///< of the last call
    std::size_t pair_room_ = 0;
    cl::Kernel ropes_kernel_;
    std::optional<Arena> arena_;
    Buffer<uint> ropes_;  ///< one a node; one word where there are none
};

}  // namespace bvhbench
