// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <numeric>
#include <span>
#include <vector>

#include "baselines/host/centres.h"
#include "baselines/host/host_builder.h"

namespace bvhbench {

/// Nodes kept as they are spelled out.
class PlainTree final : public Tree {
public:
    HostTree plain;

    std::size_t node_count() const override { return plain.nodes.size(); }
    HostTree spelled_out() const override { return plain; }
};

/// A hierarchy built from the root down, one triangle a leaf, by any way to part a set of triangles in two.
///
/// `Split` has a card and  std::size_t operator()(std::span<uint> ids, boxes, centres):  rearrange two ids or
/// more so that those of the left child come first, and say how many; at least one, and not all.
template <class Split>
class TopDown final : public HostMethod {
public:
    BuilderCard card() const override { return Split::card; }

    Footprint footprint(std::size_t primitives) const override
    {
        return {(2 * primitives - 1) * sizeof(HostTree::Node),
                primitives * (sizeof(uint) + sizeof(Centre))};
    }

    void reserve(std::size_t primitives) override
    {
        tree_.plain.nodes.resize(2 * primitives - 1);
        ids_.resize(primitives);
        centres_.resize(primitives);
    }

    void accept(std::span<const Aabb> boxes) override { boxes_ = boxes; }

    void build() override
    {
        std::iota(ids_.begin(), ids_.end(), 0u);
        std::transform(boxes_.begin(), boxes_.end(), centres_.begin(), centre_of);
        link_nodes();
        merge_boxes();
    }

    const Tree& tree() const override { return tree_; }

private:
    /// A node to come, and its ids as a range.
    struct Task {
        std::size_t node;
        std::size_t first;
        std::size_t count;
    };

    /// A stack of our own: nothing bounds the depth of a tree that follows the costs.
    void link_nodes()
    {
        std::size_t used = 1;
        std::vector<Task> tasks{{0, 0, ids_.size()}};
        while (!tasks.empty()) {
            const Task task = tasks.back();
            tasks.pop_back();
            HostTree::Node& node = tree_.plain.nodes[task.node];
            node = {};
            if (task.count == 1) {
                node.primitive = static_cast<int>(ids_[task.first]);
                continue;
            }
            const std::size_t left =
                split_(std::span(ids_).subspan(task.first, task.count), boxes_, centres_);
            node.child = {static_cast<int>(used), static_cast<int>(used + 1)};
            tasks.push_back({used + 1, task.first + left, task.count - left});
            tasks.push_back({used, task.first, left});
            used += 2;
        }
    }

    /// Children come after their parent, so the last node goes first.
    void merge_boxes()
    {
        std::vector<HostTree::Node>& nodes = tree_.plain.nodes;
        for (std::size_t i = nodes.size(); i-- > 0;) {
            HostTree::Node& node = nodes[i];
            node.box = node.primitive != HostTree::none
                           ? boxes_[static_cast<std::size_t>(node.primitive)]
                           : merged(nodes[static_cast<std::size_t>(node.child[0])].box,
                                    nodes[static_cast<std::size_t>(node.child[1])].box);
        }
    }

    Split split_;
    PlainTree tree_;
    std::span<const Aabb> boxes_;
    std::vector<uint> ids_;
    std::vector<Centre> centres_;
};

}  // namespace bvhbench
