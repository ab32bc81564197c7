// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "builders/builder.h"

namespace bvhbench {

/// A tree that is stored as a HostTree.
class PlainTree final : public Tree {
public:
    HostTree plain;

    std::size_t node_count() const override { return plain.nodes.size(); }
    HostTree to_host_tree() const override { return plain; }

    /// Computes the boxes of all inner nodes from their two children. Children must come after their parent in `nodes`.
    void merge_boxes()
    {
        std::vector<HostTree::Node>& nodes = plain.nodes;
        for (std::size_t k = nodes.size(); k-- > 0;)
            if (HostTree::Node& node = nodes[k]; node.primitive == HostTree::none)
                node.box = merged(nodes[static_cast<std::size_t>(node.child[0])].box,
                                  nodes[static_cast<std::size_t>(node.child[1])].box);
    }
};

/// Base of builders that run on the host, in the stages `bounds` (leaf boxes) and `hierarchy`. By default there are no codes and
/// no leaf order: with Start::from_sorted_leaves such a builder starts from leaf boxes.
class HostBuilder : public Builder {
public:
    HostBuilder(std::string_view name, std::string_view method)
        : card_{name, method, BuilderCard::Runs::on_host}
    {}

    BuilderCard card() const final { return card_; }

    void reserve(std::size_t primitives) final
    {
        reserve_own(primitives);
        reserved_ = footprint(primitives);
    }

    Footprint reserved() const final { return reserved_; }

    const Tree& build(const Input& input, Queue& queue, Start start) final
    {
        prepare(input, queue, start);
        queue.on_host("hierarchy", [&] { build_tree(); });
        return tree();
    }

protected:
    /// Allocates the host memory that `footprint` counts, including `boxes_` if it is used.
    virtual void reserve_own(std::size_t primitives) = 0;

    /// Runs the stages before the hierarchy. By default writes the box of triangle k to boxes_[k].
    virtual void prepare(const Input& input, Queue& queue, Start start)
    {
        if (start == Start::from_triangles)
            queue.on_host("bounds", [&] {
                for (std::size_t k = 0; k < boxes_.size(); ++k)
                    boxes_[k] = leaf_box(input, input.faces[k]);
            });
    }

    /// Builds the tree. Timed as the stage `hierarchy`.
    virtual void build_tree() = 0;

    virtual const Tree& tree() const = 0;

    std::vector<Aabb> boxes_;

private:
    BuilderCard card_;
    Footprint reserved_;
};

}  // namespace bvhbench
