// SPDX-License-Identifier: MIT
//
// Base of all colliders on the device: the frame's tree, kernels, ropes, memory, counters, and growing pair buffers.
//
//     reserve    compile; then, once to measure and once to allocate: plan, fill
//     query      ropes, if any; clear the counters; enqueue
//     complete   make_room; if any buffer was too small: save, plan and fill again
#pragma once

#include <memory>
#include <optional>

#include "builders/device_tree.h"
#include "collide/collider.h"
#include "collide/skips.h"

namespace bvhbench {

class ObjectOrder;

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
    /// Whether the collider queries a tree, and whether it walks the tree without a stack. For the latter, trees that have no
    /// arithmetic for the next node get ropes.
    enum class Wants { no_tree, tree, tree_with_ropes };

    /// `group_size` applies if the options set none. Throws BadUsage for a group size that the device does not support.
    DeviceCollider(Programs& programs, const ColliderCard& card, const ColliderOptions& options,
                   const Parameter& group_size, Wants wants);

    /// Returns the reason why the collider cannot query this kind of tree, as a sentence; empty if it can.
    virtual std::string objection(const DeviceTree&) const { return {}; }

    /// True if kernels follow pointers of this tree in loops.
    virtual bool follows_pointers(const DeviceTree& tree) const { return has_ropes(tree); }

    /// Compiles for frames like `input`; sets the initial buffer sizes and `queue_count_`.
    virtual void compile(const Input& input) = 0;

    /// Allocates buffers other than counters and pairs. `pairs_` has its size before. Runs twice; the first run measures only.
    virtual void plan(Arena& arena) = 0;

    /// `save` downloads what must survive a reallocation. `fill` uploads constant inputs of queries to new memory. Both block.
    virtual void save(const cl::CommandQueue&) {}
    virtual void fill(const cl::CommandQueue&) {}

    /// `enqueue_before` enqueues what precedes the stage `broad`; `enqueue` enqueues the search for pairs in that stage, with
    /// zeroed counters. Neither is called if there is only one triangle.
    virtual void enqueue_before(const Input&, Queue&) {}
    virtual void enqueue(const Input& input, Queue& queue) = 0;

    /// True if `tasks` and the entries of each queue fitted; otherwise the next `plan` allocates more.
    virtual bool make_room(std::uint64_t tasks, const std::vector<std::uint64_t>& queues) = 0;

    /// True if the tree has the same nodes as in the last query, so that its ropes still hold.
    virtual bool keeps_ropes() const { return false; }

    /// Lower bound on the bytes that `broad` reads: each box and each leaf's triangle once, if a tree is tested against itself.
    virtual std::int64_t reads_at_least() const;

    /// Compiles a kernel behind the tree's access header, with the defines that all such kernels have and with `more`.
    cl::Kernel kernel(std::string_view path, const char* name, std::vector<Define> more = {},
                      Optimise optimise = Optimise::freely) const;

    /// Returns the order in which pairs of objects are found; null if each object is tested against each. With a filter there is one
    /// whatever is asked of several objects.
    std::unique_ptr<ObjectOrder> object_order(const Input& input) const;

    /// Sets the arguments that all kernels share, the tree's first, then `more`.
    template <class... Arguments>
    void bind(cl::Kernel& kernel, const Input& input, const Arguments&... more) const
    {
        set_arguments_from(kernel, tree().bind(kernel, 0), ropes_, input.device_faces, pairs_,
                           static_cast<uint>(pairs_.size()), counters_, more...);
    }

    /// Launches at least `items` work-items, in work-groups of `group`.
    static void launch(const cl::Kernel& kernel, std::size_t items, std::size_t group, Queue& queue,
                       std::int64_t moved_bytes = 0)
    {
        queue.launch(kernel, (items + group - 1) / group * group, group, moved_bytes);
    }

    const DeviceTree& tree() const { return *tree_; }
    uint object_count() const { return static_cast<uint>(tree_->objects.size()); }
    bool by_groups() const { return form_ == KernelForm::groups; }
    bool skips(SkipRule rule) const { return (options_.rules_off & rule) == 0; }
    bool is_filtered() const { return !options_.filter.is_empty(); }
    bool within() const { return options_.among != Among::between_objects; }
    bool between(std::size_t objects) const
    {
        return options_.among != Among::within_objects && objects > 1;
    }
    Programs& programs() const { return programs_; }
    const Device& device() const { return programs_.device(); }

    /// Initial capacity of a list: the option `capacity` if set, else `guess`, limited by the largest allocation and by indices of
    /// 32 bits.
    std::size_t first_room(std::size_t guess, std::size_t entry_bytes = sizeof(Pair)) const;

    ColliderOptions options_;
    uint group_size_;
    std::size_t chunks_;    ///< work-items of the chunk form (for few cores)
    uint triangles_ = 0;    ///< triangles that memory is reserved for
    uint queue_count_ = 0;  ///< number of queue counters
    /// True if a kernel of each query zeroes `next_counters_`; else a command of its own clears `counters_`. Set by `compile`.
    bool zeroes_next_ = false;
    Buffer<uint> counters_, next_counters_;  ///< of two queries; layout: collide/counters.h
    Buffer<Pair> pairs_;                     ///< pairs found, in no order

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
    const DeviceTree* tree_ = nullptr;  ///< tree of the last call
    std::size_t pair_room_ = 0;
    std::vector<std::uint64_t> counts_;  ///< of the last query, since it was found complete
    cl::Kernel ropes_kernel_;
    std::optional<Arena> arena_;
    Buffer<uint> ropes_;              ///< one per node; a single word if the tree needs none
    bool has_written_ropes_ = false;  ///< whether ropes_ has those of a tree
};

}  // namespace bvhbench
