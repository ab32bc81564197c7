// SPDX-License-Identifier: MIT
//
// The oracle for radix trees: builds the tree by its definition, top-down on one core. The kernels' trees must equal it bit for
// bit. It shares nothing with them but the leaf order: no delta, no node indices, no climbing.
#include "baselines/radix/reference.h"

#include "baselines/baselines.h"

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

class RadixReference final : public OrderedHostBuilder {
public:
    explicit RadixReference(const BuildOptions& options)
        : OrderedHostBuilder("radix-reference",
                             "Binary radix tree, slowly on the host [Karras2012]", options)
    {}

private:
    void build_tree() override
    {
        tree_.plain.nodes.clear();
        for (const RadixRange& range : radix_ranges(leaves_)) {
            HostTree::Node& node = tree_.plain.nodes.emplace_back();
            const int left = static_cast<int>(range.left);
            if (range.first != range.last) {
                node.child = {left, left + 1};
                continue;
            }
            node.primitive = static_cast<int>(leaves_.ids[range.first]);
            node.box = leaves_.boxes[leaves_.ids[range.first]];
        }
        tree_.merge_boxes();
    }
};

}  // namespace

std::vector<RadixRange> radix_ranges(const HostLeafOrder& leaves)
{
    std::vector<RadixRange> ranges{{0, static_cast<uint>(leaves.ids.size()) - 1}};
    for (std::size_t k = 0; k < ranges.size(); ++k) {
        const auto [first, last, none] = ranges[k];
        if (first == last)
            continue;
        const uint split = split_of(leaves, first, last);
        ranges[k].left = ranges.size();
        ranges.push_back({first, split - 1});
        ranges.push_back({split, last});
    }
    return ranges;
}

std::unique_ptr<Builder> make_radix_reference(Programs&, const BuildOptions& options)
{
    return std::make_unique<RadixReference>(options);
}

}  // namespace bvhbench
