// SPDX-License-Identifier: MIT
//
// Shared part of all device builders over leaves in a catalog order: everything but the hierarchy.
#pragma once

#include <optional>

#include "builders/builder.h"
#include "builders/device_tree.h"
#include "builders/ordered/leaf_order.h"
#include "builders/stages/gather.h"

namespace bvhbench {

/// Manages memory, the leaf order and the stages around the hierarchy; derived classes build the hierarchy.
class OrderedBuilder : public Builder {
public:
    /// Throws BadUsage for an unknown order or box format, and for a format other than f32 without sorted leaves, because
    /// `gather` makes such boxes.
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
    /// Returns a builder with the same options and no memory.
    virtual std::unique_ptr<OrderedBuilder> twin() const = 0;

    /// Takes all buffers for objects of `sizes` triangles, those of `leaf_order_` included. Calls `plan_gather` with the
    /// destination of sorted leaves.
    virtual void plan(Arena& arena, std::span<const uint> sizes) = 0;

    /// Uploads the constant inputs of builds. Blocks until done.
    virtual void prepare(const cl::CommandQueue& queue) = 0;

    /// Enqueues the hierarchy over the leaves; `enqueue_refit`: only its boxes, with unchanged topology.
    virtual void enqueue_hierarchy(Queue& queue) = 0;
    virtual void enqueue_refit(Queue& queue) = 0;

    /// True if `enqueue_lining_up` enqueues the hierarchy and its refit over leaf boxes in mesh order, which it lines up, so that
    /// there is no stage `gather`.
    virtual bool lines_up() const { return false; }
    virtual void enqueue_lining_up(Queue&) {}

    /// True if the builder can update the trees of some objects only, through the next three functions.
    virtual bool can_update_some() const { return false; }

    /// Takes the additional memory for updates of some of several objects.
    virtual void plan_updates(Arena&) {}

    /// Plans updates of the trees of `objects`, which are rebuilt or refitted. Blocks.
    virtual void begin_update(const cl::CommandQueue&, std::span<const uint>) {}

    /// Enqueues the planned hierarchies; if the builder `lines_up`, over leaf boxes in mesh order.
    virtual void enqueue_update(Queue&) {}

    virtual DeviceTree& tree() = 0;

    /// Returns the storage format of the tree's boxes.
    const BoxFormat& format() const { return format_; }

    /// Throws BadUsage if the format is not floats; for builders that support floats only.
    void require_floats() const;

    /// Sets the destination of sorted leaf boxes to `place` and takes the additional memory of their format, after that of the
    /// leaf order. Returns the buffer of the cells that `gather` will compute; empty without sorted leaves.
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
    std::optional<GatherStage> gather_;  ///< Present with sorted leaves.
    std::optional<Arena> arena_, update_arena_;
    std::vector<uint> sizes_;  ///< Triangles of each object, as reserved.
    /// Planned update; with `of_some_` objects are updated separately, and this is the most work that one of them needs.
    TreeUpdate update_ = TreeUpdate::rebuild;
    bool of_some_ = false;
};

}  // namespace bvhbench
