// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "baselines/host/host_builder.h"
#include "builders/ordered/leaf_order.h"

namespace bvhbench {

/// A node of the radix tree: the leaves `first` to `last`.
struct RadixRange {
    uint first, last;
    std::size_t left = 0;  ///< index of the left child; the right child is the next. 0 for a leaf.
};

/// Returns the nodes of the radix tree over leaves in order, the root first and all others behind their parents.
std::vector<RadixRange> radix_ranges(const HostLeafOrder& leaves);

/// Base of oracles over ordered leaves: everything but `build_tree`, which makes tree_.plain from leaves_.
class OrderedHostBuilder : public HostBuilder {
public:
    /// Throws BadUsage for an unknown order.
    OrderedHostBuilder(std::string_view name, std::string_view method, const BuildOptions& options)
        : HostBuilder(name, method), order_(options.order)
    {
        find_order(order_);
    }

protected:
    HostLeafOrder leaves_;
    PlainTree tree_;

private:
    Footprint footprint(std::size_t primitives) const final
    {
        return {(2 * primitives - 1) * sizeof(HostTree::Node), 0};
    }

    void reserve_own(std::size_t primitives) final
    {
        tree_.plain.nodes.reserve(2 * primitives - 1);
    }

    void prepare(const Input& input, Queue& queue, Start start) final
    {
        if (start == Start::from_triangles)
            queue.on_host("sort", [&] { leaves_ = host_leaf_order(leaf_boxes(input), order_); });
    }

    const Tree& tree() const final { return tree_; }

    std::string order_;
};

}  // namespace bvhbench
