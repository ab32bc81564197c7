// SPDX-License-Identifier: MIT
#pragma once

#include "builders/implicit/tree.h"
#include "builders/ordered/ordered_builder.h"

namespace bvhbench {

/// Shared part of the builders of implicit trees, for one or several objects: memory, leaves and untimed preparation. Derived
/// classes build the hierarchy.
class ImplicitBuilder : public OrderedBuilder {
protected:
    ImplicitBuilder(Programs& programs, const BuilderCard& card, const ImplicitLayout& layout,
                    const BuildOptions& options);

    void plan(Arena& arena, std::span<const uint> sizes) final;

    /// Takes the additional memory of the hierarchy; `tree_` is planned already.
    virtual void plan_hierarchy(Arena& arena) = 0;

    void prepare(const cl::CommandQueue& queue) override;

    /// Builds the hierarchy over the old leaf order, which determines the topology of an implicit tree.
    void enqueue_refit(Queue& queue) final { enqueue_hierarchy(queue); }

    DeviceTree& tree() final { return tree_; }
    bool is_forest() const { return tree_.objects.size() > 1; }

    ImplicitTree tree_;

private:
    Buffer<uint> slots_;  ///< Several objects with sorted leaves only: see GatherPlace.
};

}  // namespace bvhbench
