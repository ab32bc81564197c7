// SPDX-License-Identifier: MIT
#include <vector>

#include "builders/ordered/leaf_order.h"
#include "oibvh/layout.h"
#include "oibvh/oibvh.h"

namespace bvhbench {
namespace {

/// The whole tree by slot, as in Section 3.
class OiHostTree final : public Tree {
public:
    OiShape shape = {};
    std::vector<Aabb> boxes;       ///< By slot.
    std::vector<uint> primitives;  ///< By position on the leaf level.

    std::size_t node_count() const override { return boxes.size(); }

    HostTree to_host_tree() const override
    {
        HostTree tree;
        tree.nodes.resize(boxes.size());
        for (uint level = 0; level <= shape.leaf_level; ++level)
            for (uint k = 0; k < oi_real_on(shape, level); ++k)
                append_node(oi_first(level) + k, tree);
        return tree;
    }

private:
    void append_node(uint i, HostTree& tree) const
    {
        HostTree::Node& node = tree.nodes[oi_slot(shape, i)];
        node.box = boxes[oi_slot(shape, i)];
        if (oi_level(i) == shape.leaf_level) {
            node.primitive = static_cast<int>(primitives[i - oi_first(shape.leaf_level)]);
            return;
        }
        node.child[0] = static_cast<int>(oi_slot(shape, oi_left(i)));
        if (oi_is_real(shape, oi_right(i)))
            node.child[1] = static_cast<int>(oi_slot(shape, oi_right(i)));
    }
};

/// Sections 3 and 4 implemented literally: implicit indices, Eq. (9) for every access, one core.
class OiReference final : public Builder {
public:
    explicit OiReference(const BuildOptions& options) : order_(options.order)
    {
        find_order(order_);
    }

    BuilderCard card() const override
    {
        return {"oibvh-reference", "Oi-BVH, slowly on the host [Chitalu2020]",
                BuilderCard::Runs::on_host};
    }

    Footprint footprint(std::size_t primitives) const override
    {
        const OiShape shape = oi_shape(static_cast<uint>(primitives));
        return {oi_node_count(shape) * sizeof(Aabb) + primitives * sizeof(uint), 0};
    }

    void reserve(std::size_t primitives) override
    {
        tree_.shape = oi_shape(static_cast<uint>(primitives));
        tree_.boxes.resize(oi_node_count(tree_.shape));
        tree_.primitives.resize(primitives);
        reserved_ = footprint(primitives);
    }

    Footprint reserved() const override { return reserved_; }

    const Tree& build(const Input& input, Queue& queue, Start start) override
    {
        if (start == Start::from_triangles)
            queue.on_host("sort", [&] { line_up_leaves(input); });
        queue.on_host("hierarchy", [&] {
            for (uint level = tree_.shape.leaf_level; level-- > 0;)
                for (uint k = 0; k < oi_real_on(tree_.shape, level); ++k)
                    join_children(oi_first(level) + k);
        });
        return tree_;
    }

private:
    void line_up_leaves(const Input& input)
    {
        HostLeafOrder leaves = host_leaf_order(leaf_boxes(input), order_);
        const uint first = oi_first(tree_.shape.leaf_level);
        for (uint k = 0; k < tree_.shape.leaves; ++k)
            tree_.boxes[oi_slot(tree_.shape, first + k)] = leaves.boxes[leaves.ids[k]];
        tree_.primitives = std::move(leaves.ids);
    }

    void join_children(uint i)
    {
        Aabb box = tree_.boxes[oi_slot(tree_.shape, oi_left(i))];
        if (oi_is_real(tree_.shape, oi_right(i)))
            box = merged(box, tree_.boxes[oi_slot(tree_.shape, oi_right(i))]);
        tree_.boxes[oi_slot(tree_.shape, i)] = box;
    }

    std::string order_;
    OiHostTree tree_;
    Footprint reserved_;
};

}  // namespace

std::unique_ptr<Builder> make_oibvh_reference(Programs&, const BuildOptions& options)
{
    return std::make_unique<OiReference>(options);
}

}  // namespace bvhbench
