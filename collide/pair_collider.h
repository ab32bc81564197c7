// SPDX-License-Identifier: MIT
//
// What all colliders on the device share, be there a tree or not: memory, counters, room for pairs and making more of
// it.
#pragma once

#include <optional>

#include "collide/collider.h"

namespace bvhbench {

class PairCollider : public Collider {
public:
    /// Throws BadUsage for a group size that the device does not have.
    PairCollider(Programs& programs, const ColliderCard& card, const ColliderOptions& options,
                 const Parameter& group_size);

    ColliderCard card() const final { return card_; }
    Footprint reserved() const final { return arena_ ? arena_->used() : Footprint{}; }
    bool complete(const Queue& queue) final;
    QueryCounts counts(const Queue& queue) const override;
    std::vector<Pair> pairs(const Queue& queue) const final;
    DevicePairs device_pairs(Queue&) final { return {pairs_, counters_}; }

protected:
    /// Take what else is needed besides counters and pairs. Run twice, first measuring.
    virtual void plan_rest(Arena& arena) = 0;

    /// Copy what must outlive the memory that goes when there is to be more. Waits.
    virtual void save(const cl::CommandQueue&) {}

    /// Write down what queries expect and leave as it was, whenever memory was taken. Waits.
    virtual void write_down(const cl::CommandQueue&) {}

    /// Queues between launches that counters are wanted for, and how to make room for so many tasks and entries.
    virtual uint wide_counters() const { return 0; }
    virtual bool make_room(std::uint64_t tasks, const std::vector<std::uint64_t>& queue_sizes) = 0;

    /// Take memory for queries of so many triangles.
    void take_memory_for(std::size_t triangles);

    bool by_groups() const { return form_ == KernelForm::groups; }
    Programs& programs() const { return programs_; }
    const Device& device() const { return programs_.device(); }
    std::vector<std::uint64_t> counters(const Queue& queue) const;

    ColliderOptions options_;
    uint group_size_;
    std::size_t chunks_;     ///< work-items of the form for few cores
    Buffer<uint> counters_;  ///< as collide/counters.h says
    Buffer<Pair> pairs_;     ///< found, in no order

private:
    void take_all(Arena& arena);
    void take_memory();

    Programs& programs_;
    ColliderCard card_;
    KernelForm form_;
    std::size_t capacity_ = 0;  ///< pairs there is room for
    std::optional<Arena> arena_;
};

}  // namespace bvhbench
