// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "builders/builder.h"

namespace bvhbench {

/// A tree that is kept as it is spelled out.
class PlainTree final : public Tree {
public:
    HostTree plain;

    std::size_t node_count() const override { return plain.nodes.size(); }
    HostTree spelled_out() const override { return plain; }

    /// Give inner nodes, of two children each, the boxes around their children's. Children come after their parent.
    void merge_boxes()
    {
        std::vector<HostTree::Node>& nodes = plain.nodes;
        for (std::size_t k = nodes.size(); k-- > 0;)
            if (HostTree::Node& node = nodes[k]; node.primitive == HostTree::none)
                node.box = merged(nodes[static_cast<std::size_t>(node.child[0])].box,
                                  nodes[static_cast<std::size_t>(node.child[1])].box);
    }
};

/// Builds on the host, by default over leaf boxes: in the stages bounds and hierarchy. It has no codes then: a start from
/// sorted leaves is a start from leaf boxes, and their order is the method's business.
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
    /// Allocate what `footprint` counts: host memory, `boxes_` first.
    virtual void reserve_own(std::size_t primitives) = 0;

    /// What comes before the hierarchy: box k becomes triangle k's.
    virtual void prepare(const Input& input, Queue& queue, Start start)
    {
        if (start == Start::from_triangles)
            queue.on_host("bounds", [&] {
                for (std::size_t k = 0; k < boxes_.size(); ++k)
                    boxes_[k] = leaf_box(input, input.faces[k]);
            });
    }

    /// Timed.
    virtual void build_tree() = 0;

    virtual const Tree& tree() const = 0;

    std::vector<Aabb> boxes_;

private:
    BuilderCard card_;
    Footprint reserved_;
};

}  // namespace bvhbench
