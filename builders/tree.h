// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <vector>

#include "builders/box_format.h"

namespace bvhbench {

/// Any tree, spelled out: the one form that tests, checks and metrics read.
struct HostTree {
    static constexpr int none = -1;
    static constexpr std::size_t most_children = 8;

    /// The first so many of `most_children`; the rest are none.
    struct Children : std::array<int, most_children> {
        Children() { fill(none); }
        Children(std::initializer_list<int> first) : Children()
        {
            std::copy(first.begin(), first.end(), begin());
        }
    };

    struct Node {
        Aabb box = {};
        Children child;        ///< all but the first may be absent: support nodes have one
        int primitive = none;  ///< set on leaves only
    };

    std::vector<Node> nodes;  ///< the root is nodes[0]; children come after their parent

    /// What a leaf's box is to its triangle's: that box, if not said otherwise.
    BoxRounding rounding;
};

/// What a builder leaves behind, in whatever layout and memory suits it.
class Tree {
public:
    virtual ~Tree() = default;

    /// Stored nodes: inner, leaf, support and padding.
    virtual std::size_t node_count() const = 0;

    /// A canonical copy, padding left out. Slow on purpose-built layouts, and never part of a measurement.
    virtual HostTree spelled_out() const = 0;
};

}  // namespace bvhbench
