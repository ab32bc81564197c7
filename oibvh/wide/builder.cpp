// SPDX-License-Identifier: MIT
#include "oibvh/wide/builder.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "builders/implicit/cut.h"
#include "builders/ordered/ordered_builder.h"
#include "geometry/error.h"
#include "oibvh/kary_layout.h"

namespace bvhbench {
namespace {

BuildOptions without_gather(BuildOptions options)
{
    options.sorted_leaves = false;
    return options;
}

class WideBuilder final : public OrderedBuilder {
public:
    WideBuilder(Programs& programs, const BuilderCard& card, const WideFormat& format,
                const BuildOptions& options)
        : OrderedBuilder(programs, card, without_gather(options))
    {
        require_floats();
        tree_.format = format;
        choose(1);  // refuses bad options now
    }

private:
    /// One launch, of all objects: those whose trees are so high take part in it.
    struct Launch {
        uint first_subtree = 0, subtrees = 0;  ///< of the list
        std::int64_t moved_bytes = 0;
    };

    /// The launches that make the trees of all objects, or of some.
    struct Launches {
        std::vector<Launch> list;
        std::vector<cl_uint2> subtree_list;  ///< object and position, launch by launch
        Buffer<cl_uint2> subtrees;
    };

    std::unique_ptr<OrderedBuilder> twin() const override
    {
        return std::make_unique<WideBuilder>(programs_, card(), tree_.format, options_);
    }

    void plan(Arena& arena, std::span<const uint> sizes) override;
    void prepare(const cl::CommandQueue& queue) override;
    void enqueue_hierarchy(Queue& queue) override { enqueue(whole_, queue); }

    /// As of any implicit tree, the topology is the order of the leaves: this is the hierarchy over the old one.
    void enqueue_refit(Queue& queue) override { enqueue(whole_, queue); }

    bool can_update_some() const override { return true; }
    void plan_updates(Arena& arena) override
    {
        update_.subtrees = arena.take<cl_uint2>(whole_.subtree_list.size(), Use::scratch);
    }
    void begin_update(const cl::CommandQueue& queue, std::span<const TreeUpdate> updates) override;
    void enqueue_update(Queue& queue) override { enqueue(update_, queue); }

    DeviceTree& tree() override { return tree_; }

    void choose(uint leaves);
    void plan_launches(Launches& launches, std::span<const uint> objects) const;
    void enqueue(const Launches& launches, Queue& queue);
    std::int64_t moved_bytes(uint leaves, uint entry_level, uint levels) const;

    uint bits() const { return tree_.format.child_bits; }
    bool by_groups() const { return cut_.form == KernelForm::groups; }

    WideTree tree_;
    Cut cut_;
    uint levels_ = 1;  ///< of wide nodes that a launch makes
    cl::Kernel from_leaves_, from_nodes_;
    Launches whole_, update_;
};

/// The binary builder's cut in whole levels of wide nodes. A group of a child a work-item is a power of the children a
/// node: 512 where there are 8 and 256 where there are 4, if no other size is asked for.
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
    plan_launches(whole_, all);

    tree_.nodes = arena.take<NodeWord>(slots * tree_.format.node_words(), Use::tree);
    tree_.device_objects = arena.take<ForestObject>(sizes.size(), Use::tree);
    leaf_order_.plan(arena, sizes, Use::scratch, false);
    tree_.ids = leaf_order_.ids();
    whole_.subtrees = arena.take<cl_uint2>(whole_.subtree_list.size(), Use::scratch);
}

void WideBuilder::plan_launches(Launches& launches, std::span<const uint> objects) const
{
    launches.list.clear();
    launches.subtree_list.clear();
    uint most_levels = 0;
    for (const uint object : objects)
        most_levels = std::max(most_levels, wide_leaf_level(tree_.objects[object].leaves, bits()));
    for (uint done = 0; done < most_levels; done += levels_) {
        Launch launch{static_cast<uint>(launches.subtree_list.size()), 0, 0};
        for (const uint object : objects) {
            const uint leaves = tree_.objects[object].leaves;
            const uint leaf_level = wide_leaf_level(leaves, bits());
            if (done >= leaf_level)
                continue;
            const uint entry_level = leaf_level - done - 1;
            const uint levels = std::min(levels_, entry_level + 1);
            const uint subtrees = wide_real_on(leaves, bits(), entry_level + 1 - levels);
            launch.subtrees += subtrees;
            launch.moved_bytes += moved_bytes(leaves, entry_level, levels);
            for (uint position = 0; position < subtrees; ++position)
                launches.subtree_list.push_back({{object, position}});
        }
        launches.list.push_back(launch);
    }
}

/// Children read once, nodes written once.
std::int64_t WideBuilder::moved_bytes(uint leaves, uint entry_level, uint levels) const
{
    const auto node_bytes = static_cast<std::int64_t>(tree_.format.node_words() * sizeof(NodeWord));
    const bool from_leaves = entry_level + 1 == wide_leaf_level(leaves, bits());
    const std::int64_t children = wide_real_on(leaves, bits(), entry_level + 1);
    std::int64_t written = 0;
    for (uint level = entry_level + 1 - levels; level <= entry_level; ++level)
        written += wide_real_on(leaves, bits(), level);
    return children * (from_leaves ? std::int64_t{sizeof(Aabb) + sizeof(uint)} : node_bytes) +
           written * node_bytes;
}

void WideBuilder::begin_update(const cl::CommandQueue& queue, std::span<const TreeUpdate> updates)
{
    std::vector<uint> objects;
    for (uint object = 0; object < updates.size(); ++object)
        if (updates[object] != TreeUpdate::keep)
            objects.push_back(object);
    plan_launches(update_, objects);
    update_.subtrees.upload(queue, update_.subtree_list);
}

void WideBuilder::prepare(const cl::CommandQueue& queue)
{
    const std::vector<Define> defines =
        by_groups() ? std::vector<Define>{{"GROUP_SIZE", cut_.group_size}} : std::vector<Define>{};
    const std::string_view path =
        by_groups() ? "oibvh/wide/build_groups.cl" : "oibvh/wide/build_items.cl";
    from_leaves_ = programs_.kernel(tree_.format.text, path, "build_from_leaves", defines);
    // The few nodes that are left: where optimising is in doubt, there is nothing to win.
    from_nodes_ =
        programs_.kernel(tree_.format.text, path, "build_from_nodes", defines, Optimise::on_gpus);
    tree_.device_objects.upload(queue, tree_.objects);
    whole_.subtrees.upload(queue, whole_.subtree_list);
}

void WideBuilder::enqueue(const Launches& launches, Queue& queue)
{
    for (uint k = 0; k < launches.list.size(); ++k) {
        const Launch& launch = launches.list[k];
        cl::Kernel& kernel = k == 0 ? from_leaves_ : from_nodes_;
        cl_uint next =
            k == 0 ? set_arguments_from(kernel, 0, leaf_order_.boxes(), tree_.ids, tree_.nodes,
                                        tree_.device_objects, launches.subtrees)
                   : set_arguments_from(kernel, 0, tree_.nodes, tree_.device_objects,
                                        launches.subtrees, launch.first_subtree, k * levels_);
        if (!by_groups())
            set_arguments_from(kernel, next, levels_);
        queue.launch(kernel, std::size_t{launch.subtrees} * cut_.group_size, cut_.group_size,
                     launch.moved_bytes);
    }
}

}  // namespace

std::unique_ptr<Builder> make_wide_builder(Programs& programs, const BuilderCard& card,
                                           const WideFormat& format, const BuildOptions& options)
{
    return std::make_unique<WideBuilder>(programs, card, format, options);
}

}  // namespace bvhbench
