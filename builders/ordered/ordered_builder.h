// SPDX-License-Identifier: MIT
//
// What device builders share that start from leaves in an order of the catalog: all but the hierarchy.
#pragma once

#include <optional>

#include "builders/builder.h"
#include "builders/device_tree.h"
#include "builders/ordered/leaf_order.h"
#include "builders/stages/gather.h"

namespace bvhbench {

/// Memory, the order of the leaves and the stages around the hierarchy, which is left to who derives from it.
class OrderedBuilder : public Builder {
public:
    /// Throws BadUsage if there is no such order or format of boxes, and for a format whose boxes are made where leaves
    /// are lined up, if they are not to be.
    OrderedBuilder(Programs& programs, const BuilderCard& card, const BuildOptions& options);

    BuilderCard card() const final { return card_; }
    Footprint footprint(std::size_t primitives) const final;
    void reserve(std::size_t primitives) final;
    void reserve_objects(std::span<const uint> sizes) final;
    Footprint reserved() const final;
    const Tree& build(const Input& input, Queue& queue, Start start) final;
    bool can_refit() const final { return true; }
    const Tree& refit(const Input& input, Queue& queue) final;
    std::vector<TreeUpdate> plan_update(std::span<const TreeUpdate> wanted, Queue& queue) final;
    const Tree& update(const Input& input, Queue& queue) final;

protected:
    /// Another one like this, without memory.
    virtual std::unique_ptr<OrderedBuilder> twin() const = 0;

    /// Take every buffer for objects of so many triangles each, `leaf_order_`'s too. With sorted leaves, plan where they go
    /// by `plan_gather`.
    virtual void plan(Arena& arena, std::span<const uint> sizes) = 0;

    /// Fill what builds expect and leave as it was. Waits.
    virtual void prepare(const cl::CommandQueue& queue) = 0;

    /// Enqueue what makes the tree of the leaves; for a refit, what makes its boxes while its topology stands.
    virtual void enqueue_hierarchy(Queue& queue) = 0;
    virtual void enqueue_refit(Queue& queue) = 0;

    /// Whether it can make the trees of some objects only, by the next three.
    virtual bool can_update_some() const { return false; }

    /// Take what updates need besides; of several objects only.
    virtual void plan_updates(Arena&) {}

    /// Write down that updates from here on make the trees of these objects, which are rebuilt or refitted. Waits.
    virtual void begin_update(const cl::CommandQueue&, std::span<const uint>) {}

    /// Enqueue what makes those.
    virtual void enqueue_update(Queue&) {}

    virtual DeviceTree& tree() = 0;

    /// What the builder's tree keeps its boxes in.
    const BoxFormat& format() const { return format_; }

    /// Throws BadUsage if that is not floats: for builders whose trees know no others.
    void require_floats() const;

    /// The boxes of sorted leaves go to `place`. Takes what lining them up in the format needs besides, once the leaves' own is
    /// taken: the cells it will find.
    Buffer<SceneCells> plan_gather(Arena& arena, const GatherPlace& place);

    Programs& programs_;
    BuildOptions options_;
    LeafOrder leaf_order_;

private:
    Footprint planned(std::span<const uint> sizes) const;
    void gather_if_sorted(const Input& input, Queue& queue);
    void reserve_updates();
    const Tree& update_some(const Input& input, Queue& queue);

    BuilderCard card_;
    const BoxFormat& format_;
    std::optional<GatherStage> gather_;  ///< with sorted leaves
    std::optional<Arena> arena_, update_arena_;
    std::vector<uint> sizes_;  ///< of the objects that there is memory for
    /// What updates do: the same for all objects, or not.
    TreeUpdate update_ = TreeUpdate::rebuild;
    bool of_some_ = false;
};

}  // namespace bvhbench
