// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include "builders/implicit/host_levels.h"
#include "builders/implicit/implicit_builder.h"
#include "device/buffer.h"

namespace bvhbench {
namespace {

/// Levels of a subtree that one thread builds: its 2^12 leaves' boxes and ids, 112 KiB, and its nodes stay in a core's
/// cache; there are enough of them for threads that are interrupted not to be waited for.
constexpr uint levels_a_subtree = 12;

/// The hierarchy by threads of the host over leaves that the device has lined up: what a kernel of the same shape is
/// measured against.
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

/// Level of the roots of the subtrees that threads build; 0 where the tree is one, or nothing but a leaf.
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
