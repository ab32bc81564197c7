// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "builders/box_format.h"

namespace bvhbench {

/// A tree on the host, independent of the builder's layout: the only form that tests, checks and metrics read.
struct HostTree {
    static constexpr int none = -1;
    static constexpr std::size_t most_children = 8;

    /// Indices of children, in the first entries; unused entries are `none`.
    struct Children : std::array<int, most_children> {
        Children() { fill(none); }
        Children(std::initializer_list<int> first) : Children()
        {
            std::copy(first.begin(), first.end(), begin());
        }
    };

    struct Node {
        Aabb box = {};
        Children child;        ///< None in leaves, one in support nodes, else two or more.
        int primitive = none;  ///< Triangle id in leaves, `none` in inner nodes.
    };

    std::vector<Node> nodes;  ///< The root is nodes[0]; children come after their parent.

    /// Rounding of leaf boxes; none by default.
    BoxRounding rounding;

    /// True for trees of code that is not ours, where a box contains what is below it and may be larger.
    bool boxes_may_be_larger = false;
};

/// Result of a builder, in the builder's own layout and memory.
class Tree {
public:
    virtual ~Tree() = default;

    /// Returns the number of stored nodes: inner, leaf, support and padding.
    virtual std::size_t node_count() const = 0;

    /// Returns a host copy without padding. Slow, and never timed.
    virtual HostTree to_host_tree() const = 0;
};

}  // namespace bvhbench
