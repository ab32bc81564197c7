// SPDX-License-Identifier: MIT
#include <numeric>
#include <vector>

#include "baselines/baselines.h"
#include "baselines/host/centres.h"
#include "baselines/host/heap.h"
#include "baselines/host/host_builder.h"

namespace bvhbench {
namespace {

class HeapTree final : public Tree {
public:
    std::vector<Aabb> boxes;  ///< by node
    std::vector<uint>
        primitives;  ///< by leaf: that of node `primitives.size() - 1 + k` is the k-th

    std::size_t node_count() const override { return boxes.size(); }

    HostTree spelled_out() const override
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

/// Nodes without pointers, in the order of a heap: a set is split along its longest axis where the shape of
/// the heap says, not where the triangles suggest.
class HeapMedian final : public HostMethod {
public:
    BuilderCard card() const override
    {
        return {"heap-median", "left-balanced heap, on one core of the host [Cline2006]",
                BuilderCard::Runs::on_host};
    }

    Footprint footprint(std::size_t primitives) const override
    {
        return {(2 * primitives - 1) * sizeof(Aabb) + primitives * sizeof(uint),
                primitives * (sizeof(uint) + sizeof(Centre))};
    }

    void reserve(std::size_t primitives) override
    {
        tree_.boxes.resize(2 * primitives - 1);
        tree_.primitives.resize(primitives);
        ids_.resize(primitives);
        centres_.resize(primitives);
    }

    void accept(std::span<const Aabb> boxes) override { boxes_ = boxes; }

    void build() override
    {
        std::iota(ids_.begin(), ids_.end(), 0u);
        std::transform(boxes_.begin(), boxes_.end(), centres_.begin(), centre_of);
        split(0, ids_);
        for (std::size_t i = ids_.size() - 1; i-- > 0;)
            tree_.boxes[i] = merged(tree_.boxes[2 * i + 1], tree_.boxes[2 * i + 2]);
    }

    const Tree& tree() const override { return tree_; }

private:
    /// As deep as the heap, a level for each bit of the number of leaves.
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
    std::span<const Aabb> boxes_;
    std::vector<uint> ids_;
    std::vector<Centre> centres_;
};

}  // namespace

std::unique_ptr<Builder> make_heap_median(Programs&, const BuildOptions&)
{
    return make_host_builder(std::make_unique<HeapMedian>());
}

}  // namespace bvhbench
