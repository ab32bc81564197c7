// SPDX-License-Identifier: MIT
#include <algorithm>

#include "baselines/radix/hierarchy.h"
#include "builders/ordered_builder.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

class RadixTree final : public DeviceTree {
public:
    RadixLeaves leaves;
    std::unique_ptr<RadixHierarchy> hierarchy;
    uint code_bits = 0;

    uint leaf_count() const override { return leaves.count; }
    bool has_sorted_leaves() const override { return leaves.sorted; }
    std::string_view access_header() const override { return hierarchy->access_header(); }
    bool is_implicit() const override { return false; }

    /// From the root down every node splits at a lower bit of its leaves' keys than its parent.
    uint most_levels() const override
    {
        return std::min(leaves.count, code_bits + ceil_log2(leaves.count) + 1);
    }

    cl_uint bind(cl::Kernel& kernel, cl_uint first) const override
    {
        return set_arguments_from(kernel, hierarchy->bind(kernel, first), leaves.boxes, leaves.ids,
                                  leaves.count);
    }

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

class RadixBuilder final : public OrderedBuilder {
public:
    RadixBuilder(Programs& programs, const BuilderCard& card, MakeRadixHierarchy make,
                 const BuildOptions& options)
        : OrderedBuilder(programs, card, options), make_(make)
    {
        tree_.leaves.sorted = options.sorted_leaves;
        tree_.code_bits = leaf_order_.code_bits();
        tree_.hierarchy = make({programs, RadixLaunch(programs.device(), options),
                                leaf_order_.code_bits(), options.sorted_leaves});
    }

private:
    std::unique_ptr<OrderedBuilder> twin() const override
    {
        return std::make_unique<RadixBuilder>(programs_, card(), make_, options_);
    }

    void plan(Arena& arena, uint primitives) override
    {
        RadixLeaves& leaves = tree_.leaves;
        leaves.count = primitives;
        leaf_order_.plan(arena, primitives, leaves.sorted ? Use::scratch : Use::tree, true);
        leaves.boxes =
            leaves.sorted ? arena.take<Aabb>(primitives, Use::tree) : leaf_order_.boxes();
        leaves.ids = leaf_order_.ids();
        leaves.codes = leaf_order_.codes();
        gathered_ = {leaves.boxes, 0};
        tree_.hierarchy->plan(arena, leaves);
    }

    void prepare(const cl::CommandQueue& queue) override { tree_.hierarchy->prepare(queue); }

    void enqueue_hierarchy(Queue& queue) override
    {
        if (tree_.leaves.count > 1)  // one leaf is its own root
            tree_.hierarchy->build(queue);
    }

    void enqueue_refit(Queue& queue) override
    {
        if (tree_.leaves.count > 1)
            tree_.hierarchy->refit(queue);
    }

    DeviceTree& tree() override { return tree_; }

    MakeRadixHierarchy make_;
    RadixTree tree_;
};

}  // namespace

std::unique_ptr<Builder> make_radix_builder(Programs& programs, const BuilderCard& card,
                                            MakeRadixHierarchy make, const BuildOptions& options)
{
    return std::make_unique<RadixBuilder>(programs, card, make, options);
}

}  // namespace bvhbench
