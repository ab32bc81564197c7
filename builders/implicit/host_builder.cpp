// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "builders/implicit/implicit_builder.h"
#include "device/buffer.h"
#include "geometry/aabb.h"

namespace bvhbench {
namespace {

/// A box in a format whose sides are not floats.
template <class Side>
struct BoxOf {
    Side low[3], high[3];
};

/// Four consecutive floats of a box from any side on: loaded by one instruction.
typedef float FourFloats __attribute__((vector_size(16), aligned(4), may_alias));

/// Returns `merged` of boxes without NaN, in two overlapping vectors: the lower four floats include the three minima, the upper
/// four the three maxima. Each comparison compiles to one instruction; `merged` needs six.
inline Aabb merged_boxes(const Aabb& a, const Aabb& b)
{
    const auto fours = [](const float& first) {
        return *reinterpret_cast<const FourFloats*>(&first);
    };
    const FourFloats a_low = fours(a.min_x), a_high = fours(a.min_z);
    const FourFloats b_low = fours(b.min_x), b_high = fours(b.min_z);
    const FourFloats low = a_low < b_low ? a_low : b_low;
    const FourFloats high = a_high > b_high ? a_high : b_high;
    return {low[0], low[1], low[2], high[1], high[2], high[3]};
}

template <class Side>
inline BoxOf<Side> merged_boxes(const BoxOf<Side>& a, const BoxOf<Side>& b)
{
    BoxOf<Side> box;
    for (int k = 0; k < 3; ++k) {
        box.low[k] = std::min(a.low[k], b.low[k]);
        box.high[k] = std::max(a.high[k], b.high[k]);
    }
    return box;
}

/// Builds the nodes `begin` to `end` - 1 of a level from the `count` nodes of the level below.
template <class Box, class Child>
inline void merge_pairs(Box* to, uint begin, uint end, uint count, const Child& child)
{
    const uint pairs = std::min(end, count / 2);
    uint p = begin;
    for (; p < pairs; ++p)
        to[p] = merged_boxes(child(2 * p), child(2 * p + 1));
    if (p < end)
        to[p] = child(2 * p);
}

/// An implicit tree in host memory, of a layout without padding: see ImplicitTree. Box is Aabb, or BoxOf doubles or of integers
/// of 16 or 8 bits.
template <class Box>
struct HostLevels {
    ImplicitLayout layout;
    uint leaves = 0;
    Box* nodes = nullptr;  ///< By slot.
    const Box* leaf_boxes =
        nullptr;                ///< In mesh order; null if leaves are in `nodes`, in leaf order.
    const uint* ids = nullptr;  ///< Triangles in leaf order.

    /// Builds the inner nodes of the subtree whose root is at `position` of `root_level`, level by level from the leaves.
    void build_subtree(uint root_level, uint position) const
    {
        for (uint level = implicit_leaf_level(leaves); level-- > root_level;) {
            const uint above = level - root_level, used = implicit_used_on(leaves, level);
            merge(level, std::min(position << above, used),
                  std::min((position + 1) << above, used));
        }
    }

    /// Builds all levels above `level`, which is complete.
    void build_above(uint level) const
    {
        while (level-- > 0)
            merge(level, 0, implicit_used_on(leaves, level));
    }

private:
    void merge(uint level, uint begin, uint end) const
    {
        Box* const to = nodes + layout.first_slot(leaves, level);
        const Box* const from = nodes + layout.first_slot(leaves, level + 1);
        if (level + 1 == implicit_leaf_level(leaves) && leaf_boxes != nullptr)
            merge_pairs(to, begin, end, leaves,
                        [this](uint k) -> const Box& { return leaf_boxes[ids[k]]; });
        else
            merge_pairs(to, begin, end, implicit_used_on(leaves, level + 1),
                        [from](uint k) -> const Box& { return from[k]; });
    }
};

/// Levels of a subtree that one thread builds. The boxes and ids of its 2^12 leaves (112 KiB) and its nodes stay in a core's
/// cache, and there are enough subtrees that an interrupted thread delays the others little.
constexpr uint levels_a_subtree = 12;

/// Builds the hierarchy on host threads over leaves that the device has ordered: a reference time for kernels of the same
/// structure.
class HostThreadsBuilder final : public ImplicitBuilder {
public:
    HostThreadsBuilder(Programs& programs, const BuilderCard& card, const ImplicitLayout& layout,
                       const BuildOptions& options)
        : ImplicitBuilder(programs, card, layout, options)
        , threads_(programs.device().is_cpu()
                       ? programs.device().cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>()
                       : std::max(1u, std::thread::hardware_concurrency()))
    {}

private:
    std::unique_ptr<OrderedBuilder> twin() const override
    {
        return std::make_unique<HostThreadsBuilder>(programs_, card(), tree_.layout, options_);
    }

    void plan_hierarchy(Arena&) override {}

    void enqueue_hierarchy(Queue& queue) override
    {
        switch (format().number) {
            case BOX_F32:
                return enqueue_boxes<Aabb>(queue);
            case BOX_F64:
                return enqueue_boxes<BoxOf<double>>(queue);
            case BOX_U8:
                return enqueue_boxes<BoxOf<std::uint8_t>>(queue);
            default:
                return enqueue_boxes<BoxOf<std::uint16_t>>(queue);
        }
    }

    template <class Box>
    void enqueue_boxes(Queue& queue)
    {
        const Mapped nodes(queue.cl(), tree_.nodes.as<Box>(), CL_MAP_READ | CL_MAP_WRITE);
        const Mapped leaf_boxes(queue.cl(), tree_.leaf_boxes.as<Box>(), CL_MAP_READ);
        const Mapped ids(queue.cl(), tree_.ids, CL_MAP_READ);
        std::vector<HostLevels<Box>> trees;
        for (const ForestObject& object : tree_.objects)
            trees.push_back({tree_.layout, object.leaves, nodes.data() + object.nodes,
                             leaf_boxes.data(), ids.data() + object.first});
        queue.work_on_host([&] { build(trees); });
    }

    template <class Box>
    void build(const std::vector<HostLevels<Box>>& trees) const;

    unsigned threads_;
};

/// Returns the level of the roots of the subtrees that threads build; 0 if the tree is one subtree or one leaf.
uint root_level(uint leaves)
{
    const uint leaf_level = implicit_leaf_level(leaves);
    return leaf_level > levels_a_subtree ? leaf_level - levels_a_subtree : 0;
}

template <class Box>
void HostThreadsBuilder::build(const std::vector<HostLevels<Box>>& trees) const
{
    struct Subtree {
        const HostLevels<Box>* tree;
        uint position;
    };
    std::vector<Subtree> subtrees;
    for (const HostLevels<Box>& tree : trees)
        for (uint k = 0;
             tree.leaves > 1 && k < implicit_used_on(tree.leaves, root_level(tree.leaves)); ++k)
            subtrees.push_back({&tree, k});

    std::atomic<std::size_t> next{0};
    const auto work = [&] {
        for (std::size_t k; (k = next++) < subtrees.size();)
            subtrees[k].tree->build_subtree(root_level(subtrees[k].tree->leaves),
                                            subtrees[k].position);
    };
    {
        std::vector<std::jthread> helpers;
        for (std::size_t k = 1; k < std::min<std::size_t>(threads_, subtrees.size()); ++k)
            helpers.emplace_back(work);
        work();
    }
    for (const HostLevels<Box>& tree : trees)
        tree.build_above(root_level(tree.leaves));
}

}  // namespace

std::unique_ptr<Builder> make_host_implicit_builder(Programs& programs, const BuilderCard& card,
                                                    const ImplicitLayout& layout,
                                                    const BuildOptions& options)
{
    return std::make_unique<HostThreadsBuilder>(programs, card, layout, options);
}

}  // namespace bvhbench
