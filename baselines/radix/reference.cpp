// SPDX-License-Identifier: MIT
//
// The oracle for radix trees: builds the tree by its definition, top-down on one core. The kernels' trees must equal it bit for
// bit. It shares nothing with them but the leaf order: no delta, no node indices, no climbing.
#include <string>
#include <vector>

#include "baselines/baselines.h"
#include "baselines/host/host_builder.h"
#include "builders/ordered/leaf_order.h"

namespace bvhbench {
namespace {

/// Returns bit `bit` of a leaf's key, which is its code followed by its 32-bit place in leaf order.
bool key_bit(const HostLeafOrder& leaves, uint leaf, int bit)
{
    return bit >= 32 ? (leaves.codes[leaf] >> (bit - 32) & 1) != 0 : (leaf >> bit & 1) != 0;
}

/// Returns the first leaf of the right child: the first one in which the highest bit that differs between first and last is 1.
uint split_of(const HostLeafOrder& leaves, uint first, uint last)
{
    int bit = 95;
    while (key_bit(leaves, first, bit) == key_bit(leaves, last, bit))
        --bit;
    uint split = first, beyond = last;  // the bit is 0 at split and 1 at beyond
    while (beyond - split > 1) {
        const uint middle = split + (beyond - split) / 2;
        (key_bit(leaves, middle, bit) ? beyond : split) = middle;
    }
    return beyond;
}

void make_radix_tree(HostTree& tree, const HostLeafOrder& leaves)
{
    struct Range {
        uint first, last;
    };
    tree.nodes.clear();
    std::vector<Range> ranges{{0, static_cast<uint>(leaves.ids.size()) - 1}};  // node k's leaves
    for (std::size_t k = 0; k < ranges.size(); ++k) {
        const auto [first, last] = ranges[k];
        HostTree::Node& node = tree.nodes.emplace_back();
        if (first == last) {
            node.primitive = static_cast<int>(leaves.ids[first]);
            node.box = leaves.boxes[leaves.ids[first]];
            continue;
        }
        const uint split = split_of(leaves, first, last);
        node.child = {static_cast<int>(ranges.size()), static_cast<int>(ranges.size() + 1)};
        ranges.push_back({first, split - 1});
        ranges.push_back({split, last});
    }
}

class RadixReference final : public HostBuilder {
public:
    explicit RadixReference(const BuildOptions& options)
        : HostBuilder("radix-reference", "Binary radix tree, slowly on the host [Karras2012]")
        , order_(options.order)
    {
        find_order(order_);
    }

private:
    Footprint footprint(std::size_t primitives) const override
    {
        return {(2 * primitives - 1) * sizeof(HostTree::Node), 0};
    }

    void reserve_own(std::size_t primitives) override
    {
        tree_.plain.nodes.reserve(2 * primitives - 1);
    }

    void prepare(const Input& input, Queue& queue, Start start) override
    {
        if (start == Start::from_triangles)
            queue.on_host("sort", [&] { leaves_ = host_leaf_order(leaf_boxes(input), order_); });
    }

    void build_tree() override
    {
        make_radix_tree(tree_.plain, leaves_);
        tree_.merge_boxes();
    }

    const Tree& tree() const override { return tree_; }

    std::string order_;
    HostLeafOrder leaves_;
    PlainTree tree_;
};

}  // namespace

std::unique_ptr<Builder> make_radix_reference(Programs&, const BuildOptions& options)
{
    return std::make_unique<RadixReference>(options);
}

}  // namespace bvhbench
