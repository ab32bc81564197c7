// SPDX-License-Identifier: MIT
#include <cassert>
#include <optional>

#include "baselines/radix/hierarchy.h"
#include "builders/stages/gather.h"
#include "builders/stages/leaf_order.h"

namespace bvhbench {
namespace {

class RadixTree final : public Tree {
public:
    RadixLeaves leaves;
    std::unique_ptr<RadixHierarchy> hierarchy;
    const Queue* queue =
        nullptr;  ///< where the last build was enqueued; set before anything is read

    std::size_t node_count() const override { return 2 * std::size_t{leaves.count} - 1; }

    /// Breadth-first: a radix tree may be 95 levels deep, so nothing here recurses.
    HostTree spelled_out() const override
    {
        const std::vector<Aabb> boxes = leaves.boxes.download(queue->cl());
        const std::vector<uint> ids = leaves.ids.download(queue->cl());
        uint root = 0;
        const std::vector<RadixNode> inner = hierarchy->download(queue->cl(), root);

        HostTree tree;
        std::vector<uint> order{radix_child(root, leaves.count == 1)};
        for (std::size_t k = 0; k < order.size(); ++k) {
            HostTree::Node& node = tree.nodes.emplace_back();
            const uint index = radix_index(order[k]);
            if (radix_is_leaf(order[k])) {
                node.primitive = static_cast<int>(ids.at(index));
                node.box = boxes.at(leaves.sorted ? index : ids[index]);
                continue;
            }
            const RadixNode& from = inner.at(index);
            node.box = {from.min_x, from.min_y, from.min_z, from.max_x, from.max_y, from.max_z};
            if (order.size() >= node_count())
                continue;  // not a tree: leave children out rather than walk in circles
            node.child = {static_cast<int>(order.size()), static_cast<int>(order.size() + 1)};
            order.push_back(from.left);
            order.push_back(from.right);
        }
        return tree;
    }
};

class RadixBuilder final : public Builder {
public:
    RadixBuilder(Programs& programs, const BuilderCard& card, MakeRadixHierarchy make,
                 const BuildOptions& options)
        : programs_(programs)
        , card_(card)
        , make_(make)
        , options_(options)
        , leaf_order_(programs, options.order)
        , gather_(programs)
    {
        options_.order = find_order(options.order).name;  // outlives the caller's text
        tree_.leaves.sorted = options.sorted_leaves;
        tree_.hierarchy = make({programs, RadixLaunch(programs.device(), options),
                                leaf_order_.code_bits(), options.sorted_leaves});
    }

    BuilderCard card() const override { return card_; }
    Footprint reserved() const override { return arena_ ? arena_->used() : Footprint{}; }

    Footprint footprint(std::size_t primitives) const override
    {
        // A twin plans, so that a builder that has memory keeps it.
        RadixBuilder twin(programs_, card_, make_, options_);
        Arena arena = Arena::measuring(programs_.device());
        twin.plan(arena, static_cast<uint>(primitives));
        return arena.used();
    }

    void reserve(std::size_t primitives) override
    {
        const Footprint wanted = footprint(primitives);
        arena_.reset();  // the old memory goes before the new comes
        arena_ = Arena::reserved(programs_.device(), wanted);
        plan(*arena_, static_cast<uint>(primitives));
        const Device& device = programs_.device();
        tree_.hierarchy->prepare(cl::CommandQueue(device.context, device.cl));
    }

    const Tree& build(const Input& input, Queue& queue, Start start) override
    {
        assert(input.triangle_count() == tree_.leaves.count);
        tree_.queue = &queue;
        if (start == Start::from_triangles) {
            leaf_order_.enqueue(input, queue);
            gather_if_sorted(queue);
        }
        queue.begin("hierarchy");
        if (tree_.leaves.count > 1)  // one leaf is its own root
            tree_.hierarchy->build(queue);
        return tree_;
    }

    bool can_refit() const override { return true; }

    const Tree& refit(const Input& input, Queue& queue) override
    {
        assert(input.triangle_count() == tree_.leaves.count);
        tree_.queue = &queue;
        leaf_order_.enqueue_boxes(input, queue);
        gather_if_sorted(queue);
        queue.begin("refit");
        if (tree_.leaves.count > 1)
            tree_.hierarchy->refit(queue);
        return tree_;
    }

private:
    void gather_if_sorted(Queue& queue)
    {
        if (tree_.leaves.sorted)
            gather_.enqueue(leaf_order_.boxes(), leaf_order_.ids(), tree_.leaves.boxes, 0, queue);
    }

    void plan(Arena& arena, uint primitives)
    {
        RadixLeaves& leaves = tree_.leaves;
        leaves.count = primitives;
        leaf_order_.plan(arena, primitives, leaves.sorted ? Use::scratch : Use::tree, true);
        leaves.boxes =
            leaves.sorted ? arena.take<Aabb>(primitives, Use::tree) : leaf_order_.boxes();
        leaves.ids = leaf_order_.ids();
        leaves.codes = leaf_order_.codes();
        tree_.hierarchy->plan(arena, leaves);
    }

    Programs& programs_;
    BuilderCard card_;
    MakeRadixHierarchy make_;
    BuildOptions options_;
    LeafOrder leaf_order_;
    GatherStage gather_;
    std::optional<Arena> arena_;
    RadixTree tree_;
};

}  // namespace

std::unique_ptr<Builder> make_radix_builder(Programs& programs, const BuilderCard& card,
                                            MakeRadixHierarchy make, const BuildOptions& options)
{
    return std::make_unique<RadixBuilder>(programs, card, make, options);
}

}  // namespace bvhbench
