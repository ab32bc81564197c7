// SPDX-License-Identifier: MIT
//
// The tree of Section 3.1 built by definition, node by node: the oracle for both layouts.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bvhbench {

/// Uses no formula of the paper. It draws a perfect tree that is just wide enough. The leaves after the t-th are virtual; an
/// inner node is virtual if all its children are. Labels count all nodes by level from the left, slots only real ones.
class LiteralTree {
public:
    struct Node {
        std::size_t level = 0;
        bool real = false;
        std::uint64_t slot = 0;         ///< real nodes only
        std::size_t real_children = 0;  ///< 0 for leaves
    };

    LiteralTree(std::size_t leaves, std::size_t arity) : arity_(arity)
    {
        std::vector<std::size_t> widths = {1};
        while (widths.back() < leaves)
            widths.push_back(widths.back() * arity);
        for (std::size_t level = 0; level < widths.size(); ++level) {
            firsts_.push_back(nodes.size());
            for (std::size_t position = 0; position < widths[level]; ++position)
                nodes.push_back({.level = level});
        }
        for (std::size_t label = firsts_.back(); label < nodes.size(); ++label)
            nodes[label].real = label - firsts_.back() < leaves;
        for (std::size_t label = firsts_.back(); label-- > 0;) {
            for (std::size_t j = 0; j < arity; ++j)
                nodes[label].real_children += nodes[child(label, j)].real ? 1u : 0u;
            nodes[label].real = nodes[label].real_children > 0;
        }
        for (Node& node : nodes)
            if (node.real)
                node.slot = real_count++;
    }

    std::size_t level_count() const { return firsts_.size(); }
    std::size_t first(std::size_t level) const { return firsts_[level]; }

    /// Returns the label of the j-th child, j from 0, with `arity` children per parent.
    std::size_t child(std::size_t label, std::size_t j) const
    {
        const std::size_t level = nodes[label].level;
        return firsts_[level + 1] + (label - firsts_[level]) * arity_ + j;
    }

    /// Returns the label of the parent of a node other than the root.
    std::size_t parent(std::size_t label) const
    {
        const std::size_t level = nodes[label].level;
        return firsts_[level - 1] + (label - firsts_[level]) / arity_;
    }

    std::vector<Node> nodes;  ///< by label: breadth first, including virtual nodes
    std::uint64_t real_count = 0;

private:
    std::size_t arity_;
    std::vector<std::size_t> firsts_;
};

}  // namespace bvhbench
