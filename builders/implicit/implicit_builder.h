// SPDX-License-Identifier: MIT
#pragma once

#include "builders/implicit/tree.h"
#include "builders/ordered/ordered_builder.h"

namespace bvhbench {

/// What builders of implicit trees share, one tree or several: memory, leaves, what is never timed. How the
/// hierarchy is made is left to who derives from it.
class ImplicitBuilder : public OrderedBuilder {
protected:
    ImplicitBuilder(Programs& programs, const BuilderCard& card, const ImplicitLayout& layout,
                    const BuildOptions& options);

    void plan(Arena& arena, std::span<const uint> sizes) final;

    /// Take what making the hierarchy needs besides; `tree_` is planned.
    virtual void plan_hierarchy(Arena& arena) = 0;

    void prepare(const cl::CommandQueue& queue) override;

    /// The topology of an implicit tree is the order of its leaves, so this is the hierarchy over the old one.
    void enqueue_refit(Queue& queue) final { enqueue_hierarchy(queue); }

    DeviceTree& tree() final { return tree_; }
    bool is_forest() const { return tree_.objects.size() > 1; }

    ImplicitTree tree_;

private:
    Buffer<uint> slots_;  ///< of several objects' sorted leaves: see GatherPlace
};

}  // namespace bvhbench
