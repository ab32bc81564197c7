// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "geometry/aabb.h"

namespace bvhbench {

/// Any tree, spelled out: the one form that tests, checks and metrics read.
struct HostTree {
    static constexpr int none = -1;

    struct Node {
        Aabb box = {};
        std::array<int, 2> child = {none,
                                    none};  ///< the second may be absent: support nodes have one
        int primitive = none;               ///< set on leaves only
    };

    std::vector<Node> nodes;  ///< the root is nodes[0]; children come after their parent
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
