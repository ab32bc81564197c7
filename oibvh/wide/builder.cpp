// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numeric>
#include <string>

#include "builders/implicit/cut.h"
#include "builders/implicit/launches.h"
#include "builders/ordered/ordered_builder.h"
#include "geometry/error.h"
#include "oibvh/kary_layout.h"
#include "oibvh/oibvh.h"
#include "oibvh/wide/tree.h"

namespace bvhbench {
namespace {

BuildOptions without_gather(BuildOptions options)
{
    options.sorted_leaves = false;
    return options;
}

/// Builds the trees of Appendix C bottom-up in several launches, with kernels for the kind of device. Ignores `sorted_leaves`:
/// nodes hold the leaf boxes in leaf order in any case.
class WideBuilder final : public OrderedBuilder {
public:
    WideBuilder(Programs& programs, const BuilderCard& card, const WideFormat& format,
                const BuildOptions& options)
        : OrderedBuilder(programs, card, without_gather(options))
    {
        require_floats();
        tree_.format = format;
        choose(1);  // throws for bad options now
    }

private:
    std::unique_ptr<OrderedBuilder> twin() const override
    {
        return std::make_unique<WideBuilder>(programs_, card(), tree_.format, options_);
    }

    void plan(Arena& arena, std::span<const uint> sizes) override;
    void prepare(const cl::CommandQueue& queue) override;
    void enqueue_hierarchy(Queue& queue) override { enqueue(whole_, queue); }

    /// Builds the hierarchy over the old leaf order, which determines the topology of an implicit tree.
    void enqueue_refit(Queue& queue) override { enqueue(whole_, queue); }

    bool can_update_some() const override { return true; }
    void plan_updates(Arena& arena) override { update_.take(arena, whole_); }
    void begin_update(const cl::CommandQueue& queue, std::span<const uint> objects) override
    {
        update_.plan(objects, launch_plan());
        update_.upload(queue);
    }
    void enqueue_update(Queue& queue) override { enqueue(update_, queue); }

    DeviceTree& tree() override { return tree_; }

    void choose(uint leaves);
    LaunchPlan launch_plan() const;
    void enqueue(const Launches& launches, Queue& queue);
    std::int64_t moved_bytes(uint leaves, const SubtreeLaunch& launch) const;

    uint bits() const { return tree_.format.child_bits; }
    bool by_groups() const { return cut_.form == KernelForm::groups; }

    WideTree tree_;
    Cut cut_;
    uint levels_ = 1;  ///< Levels of wide nodes per launch.
    cl::Kernel from_leaves_, from_nodes_;
    Launches whole_, update_;
};

/// Uses the binary builder's cut, in whole levels of wide nodes. A group has one child per work-item, so its size is a power of
/// the arity. Without a requested size, groups have 512 work-items for arity 8 and at least 256 for arity 4.
void WideBuilder::choose(uint leaves)
{
    cut_ = choose_cut(programs_.device(), {.group_size = options_.group_size},
                      Meeting::between_launches, leaves);
    if (by_groups()) {
        const uint wanted = options_.group_size != 0
                                ? options_.group_size
                                : std::max(cut_.group_size, bits() == 3 ? 512u : 256u);
        levels_ = std::max(1u, floor_log2(wanted) / bits());
        cut_.group_size = 1u << (bits() * levels_);
    } else {
        levels_ = std::max(1u, cut_.levels / bits());
    }
}

void WideBuilder::plan(Arena& arena, std::span<const uint> sizes)
{
    tree_.leaves = std::accumulate(sizes.begin(), sizes.end(), 0u);
    tree_.most_leaves = *std::max_element(sizes.begin(), sizes.end());
    if (tree_.most_leaves > kary_most_leaves(tree_.format.children()))
        throw Unavailable(std::string(card().name) + " has labels for " +
                          std::to_string(kary_most_leaves(tree_.format.children())) +
                          " triangles, not " + std::to_string(tree_.most_leaves));
    tree_.objects.clear();
    uint first = 0, slots = 0;
    for (const uint size : sizes) {
        tree_.objects.push_back({first, size, slots, 1});
        first += size;
        slots += wide_inner_count(size, bits());
    }
    choose(tree_.most_leaves);
    std::vector<uint> all(sizes.size());
    std::iota(all.begin(), all.end(), 0u);
    whole_.plan(all, launch_plan());

    tree_.nodes = arena.take<NodeWord>(slots * tree_.format.node_words(), Use::tree);
    tree_.device_objects = arena.take<ForestObject>(sizes.size(), Use::tree);
    leaf_order_.plan(arena, sizes, Use::scratch, false);
    tree_.ids = leaf_order_.ids();
    whole_.take(arena, whole_);
}

LaunchPlan WideBuilder::launch_plan() const
{
    return {.objects = tree_.objects,
            .schedule =
                [this](uint leaves) {
                    return subtree_schedule(
                        wide_leaf_level(leaves, bits()), levels_,
                        [&](uint level) { return wide_real_on(leaves, bits(), level); });
                },
            .moved_bytes = std::bind_front(&WideBuilder::moved_bytes, this)};
}

/// Returns the bytes moved: children read once, nodes written once.
std::int64_t WideBuilder::moved_bytes(uint leaves, const SubtreeLaunch& launch) const
{
    const auto node_bytes = static_cast<std::int64_t>(tree_.format.node_words() * sizeof(NodeWord));
    const bool from_leaves = launch.entry_level + 1 == wide_leaf_level(leaves, bits());
    const std::int64_t children = wide_real_on(leaves, bits(), launch.entry_level + 1);
    std::int64_t written = 0;
    for (uint k = 0; k < launch.levels; ++k)
        written += wide_real_on(leaves, bits(), launch.entry_level - k);
    return children * (from_leaves ? std::int64_t{sizeof(Aabb) + sizeof(uint)} : node_bytes) +
           written * node_bytes;
}

void WideBuilder::prepare(const cl::CommandQueue& queue)
{
    const auto kernel = [&](bool from_leaves, Optimise optimise) {
        std::vector<Define> defines = {{"SEVERAL_OBJECTS", tree_.objects.size() > 1 ? 1u : 0u},
                                       {"FROM_LEAVES", from_leaves ? 1u : 0u}};
        if (by_groups())
            defines.push_back({"GROUP_SIZE", cut_.group_size});
        return programs_.kernel(
            tree_.format.text,
            by_groups() ? "oibvh/wide/build_groups.cl" : "oibvh/wide/build_items.cl", "build",
            defines, optimise);
    };
    from_leaves_ = kernel(true, Optimise::freely);
    // These kernels build only the few upper nodes, so optimisation that may be unsafe would gain nothing.
    from_nodes_ = kernel(false, Optimise::on_gpus);
    tree_.device_objects.upload(queue, tree_.objects);
    whole_.upload(queue);
}

void WideBuilder::enqueue(const Launches& launches, Queue& queue)
{
    for (uint k = 0; k < launches.list.size(); ++k) {
        const Launch& launch = launches.list[k];
        cl::Kernel& kernel = k == 0 ? from_leaves_ : from_nodes_;
        const cl_uint next = set_arguments_from(
            kernel, 0, leaf_order_.boxes(), tree_.ids, tree_.nodes, tree_.device_objects,
            launches.subtrees, tree_.leaves, launch.first_subtree, k * levels_);
        if (!by_groups())
            set_arguments_from(kernel, next, levels_);
        queue.launch(kernel, std::size_t{launch.subtrees} * cut_.group_size, cut_.group_size,
                     launch.moved_bytes);
    }
}

}  // namespace

std::unique_ptr<Builder> make_oibvh_wide4(Programs& programs, const BuildOptions& options)
{
    const BuilderCard card = {"oibvh-wide4", "Oi-BVH, 4 children a node [Chitalu2020, App. C]",
                              BuilderCard::Runs::on_device};
    return std::make_unique<WideBuilder>(programs, card,
                                         WideFormat{2, "oibvh/wide/wide4_access.clh"}, options);
}

std::unique_ptr<Builder> make_oibvh_wide8(Programs& programs, const BuildOptions& options)
{
    const BuilderCard card = {"oibvh-wide8", "Oi-BVH, 8 children a node [Chitalu2020, App. C]",
                              BuilderCard::Runs::on_device};
    return std::make_unique<WideBuilder>(programs, card,
                                         WideFormat{3, "oibvh/wide/wide8_access.clh"}, options);
}

}  // namespace bvhbench
