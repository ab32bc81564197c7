// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <numeric>
#include <vector>

#include "baselines/baselines.h"
#include "baselines/host/centres.h"
#include "baselines/host/host_builder.h"

namespace bvhbench {
namespace {

/// Returns the number of leaves under the left child of a left-balanced tree of `leaves` >= 2 leaves. In such a tree every level
/// but the last is full and the last is filled from the left, so level-order numbers have no gaps.
///
///     5 leaves              0
///                     1           2         left: 3, right: 2
///                  3     4     5     6
///                 7 8
constexpr std::size_t heap_left_leaves(std::size_t leaves)
{
    const std::size_t full = std::bit_floor(leaves);  // leaves of the tree without its last level
    return std::min(full, leaves - full / 2);
}

static_assert(heap_left_leaves(2) == 1);
static_assert(heap_left_leaves(3) == 2);
static_assert(heap_left_leaves(4) == 2);
static_assert(heap_left_leaves(5) == 3);
static_assert(heap_left_leaves(6) == 4);
static_assert(heap_left_leaves(7) == 4);

class HeapTree final : public Tree {
public:
    std::vector<Aabb> boxes;       ///< by node
    std::vector<uint> primitives;  ///< by leaf; the leaves are the last nodes

    std::size_t node_count() const override { return boxes.size(); }

    HostTree to_host_tree() const override
    {
        const std::size_t inner = primitives.size() - 1;
        HostTree tree;
        tree.nodes.resize(boxes.size());
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            tree.nodes[i].box = boxes[i];
            if (i >= inner)
                tree.nodes[i].primitive = static_cast<int>(primitives[i - inner]);
            else
                tree.nodes[i].child = {static_cast<int>(2 * i + 1), static_cast<int>(2 * i + 2)};
        }
        return tree;
    }
};

/// Builds a tree in heap order, without pointers: each set is split along its longest axis, in the sizes that the heap dictates.
class HeapMedian final : public HostBuilder {
public:
    HeapMedian()
        : HostBuilder("heap-median", "left-balanced heap, on one core of the host [Cline2006]")
    {}

private:
    Footprint footprint(std::size_t primitives) const override
    {
        return {(2 * primitives - 1) * sizeof(Aabb) + primitives * sizeof(uint),
                primitives * (sizeof(Aabb) + sizeof(uint) + sizeof(Centre))};
    }

    void reserve_own(std::size_t primitives) override
    {
        boxes_.resize(primitives);
        tree_.boxes.resize(2 * primitives - 1);
        tree_.primitives.resize(primitives);
        ids_.resize(primitives);
        centres_.resize(primitives);
    }

    void build_tree() override
    {
        std::iota(ids_.begin(), ids_.end(), 0u);
        std::transform(boxes_.begin(), boxes_.end(), centres_.begin(), centre_of);
        split(0, ids_);
        for (std::size_t i = ids_.size() - 1; i-- > 0;)
            tree_.boxes[i] = merged(tree_.boxes[2 * i + 1], tree_.boxes[2 * i + 2]);
    }

    const Tree& tree() const override { return tree_; }

    /// Builds the subtree of `node` over `ids`. The recursion is as deep as the heap: about log2 of the number of leaves.
    void split(std::size_t node, std::span<uint> ids)
    {
        if (ids.size() == 1) {
            tree_.boxes[node] = boxes_[ids.front()];
            tree_.primitives[node - (ids_.size() - 1)] = ids.front();
            return;
        }
        const std::size_t left = heap_left_leaves(ids.size());
        split_at(ids, centres_, left);
        split(2 * node + 1, ids.first(left));
        split(2 * node + 2, ids.subspan(left));
    }

    HeapTree tree_;
    std::vector<uint> ids_;
    std::vector<Centre> centres_;
};

}  // namespace

std::unique_ptr<Builder> make_heap_median(Programs&, const BuildOptions&)
{
    return std::make_unique<HeapMedian>();
}

}  // namespace bvhbench
