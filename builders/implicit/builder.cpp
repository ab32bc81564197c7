// SPDX-License-Identifier: MIT
#include <algorithm>

#include "builders/implicit/cut.h"
#include "builders/implicit/layout.h"
#include "builders/implicit/schedule.h"
#include "builders/implicit/tree.h"
#include "builders/ordered_builder.h"

namespace bvhbench {
namespace {

class ImplicitBuilder final : public OrderedBuilder {
public:
    ImplicitBuilder(Programs& programs, const BuilderCard& card, const ImplicitLayout& layout,
                    Meeting meeting, const BuildOptions& options)
        : OrderedBuilder(programs, card, options), meeting_(meeting)
    {
        choose_cut(programs.device(), options, meeting, 1);  // refuses bad options now
        tree_.layout = layout;
        tree_.sorted_leaves = options.sorted_leaves;
    }

private:
    std::unique_ptr<OrderedBuilder> twin() const override
    {
        return std::make_unique<ImplicitBuilder>(programs_, card(), tree_.layout, meeting_,
                                                 options_);
    }

    void enqueue_hierarchy(Queue& queue) override
    {
        for (uint i = 0; i < schedule_.count; ++i)
            launch(schedule_.launches[i], queue);
    }

    /// The topology of an implicit tree is the order of its leaves, so this is the hierarchy over the old one.
    void enqueue_refit(Queue& queue) override { enqueue_hierarchy(queue); }

    DeviceTree& tree() override { return tree_; }

    bool handoff() const { return meeting_ == Meeting::by_handoff; }
    bool by_groups() const { return cut_.form == KernelForm::groups; }
    uint leaf_level() const { return implicit_leaf_level(tree_.leaves); }
    uint stored_on(uint level) const { return tree_.layout.stored_on(tree_.leaves, level); }
    uint leaf_slot() const { return tree_.layout.first_slot(tree_.leaves, leaf_level()); }

    cl::Kernel kernel(const char* name) const
    {
        if (!by_groups())
            return programs_.kernel(tree_.layout.build_items, name);
        return programs_.kernel(
            tree_.layout.build_groups, name,
            {{"GROUP_SIZE", cut_.group_size}, {"ITEMS", cut_.items}, {"LEVELS", cut_.levels}});
    }

    void plan(Arena& arena, uint primitives) override;
    void prepare(const cl::CommandQueue& queue) override;
    void launch(const SubtreeLaunch& launch, Queue& queue);
    std::int64_t moved_bytes(const SubtreeLaunch& launch) const;

    Meeting meeting_;
    Cut cut_;
    cl::Kernel from_ids_, from_nodes_;
    ImplicitTree tree_;
    SubtreeSchedule schedule_;
    Buffer<uint> arrivals_;  ///< hand-off only: one a node above the first launch's subtrees
};

void ImplicitBuilder::plan(Arena& arena, uint primitives)
{
    tree_.leaves = primitives;
    cut_ = choose_cut(programs_.device(), options_, meeting_, primitives);
    schedule_ =
        subtree_schedule(leaf_level(), cut_.levels, [&](uint level) { return stored_on(level); });
    if (handoff())
        schedule_.count = std::min(schedule_.count, 1u);

    const uint inner = leaf_slot();
    const uint stored_leaves = stored_on(leaf_level());
    tree_.nodes = arena.take<Aabb>(tree_.sorted_leaves ? inner + stored_leaves : inner, Use::tree);
    if (!tree_.sorted_leaves)  // what a padded layout stores past the leaves
        arena.take<Aabb>(stored_leaves - primitives, Use::tree);
    arena.take<uint>(stored_leaves - primitives, Use::tree);

    leaf_order_.plan(arena, primitives, tree_.sorted_leaves ? Use::scratch : Use::tree, false);
    tree_.leaf_boxes = tree_.sorted_leaves ? Buffer<Aabb>{} : leaf_order_.boxes();
    tree_.ids = leaf_order_.ids();
    gathered_ = {tree_.nodes, leaf_slot()};

    const SubtreeLaunch& first = schedule_.launches[0];
    const uint above =
        handoff() && schedule_.count > 0
            ? tree_.layout.first_slot(primitives, first.entry_level + 1 - first.levels)
            : 0;
    arrivals_ = arena.take<uint>(above, Use::scratch);
}

void ImplicitBuilder::prepare(const cl::CommandQueue& queue)
{
    from_ids_ = kernel(handoff() ? "single_from_ids" : "multi_from_ids");
    from_nodes_ = kernel(handoff() ? "single_from_nodes" : "multi_from_nodes");
    arrivals_.upload(queue, std::vector<uint>(arrivals_.size(), 0u));
    if (tree_.sorted_leaves)  // padding that a traversal may read
        tree_.nodes.upload(queue, std::vector<Aabb>(tree_.nodes.size(), empty_box()));
}

void ImplicitBuilder::launch(const SubtreeLaunch& launch, Queue& queue)
{
    const bool from_ids = launch.entry_level + 1 == leaf_level() && !tree_.sorted_leaves;
    cl::Kernel& kernel = from_ids ? from_ids_ : from_nodes_;
    cl_uint index = 0;
    const auto argument = [&](const auto& value) { kernel.setArg(index++, memory_of(value)); };
    if (from_ids) {
        argument(tree_.leaf_boxes);
        argument(tree_.ids);
    }
    argument(tree_.nodes);
    if (handoff())
        argument(arrivals_);
    argument(tree_.leaves);
    argument(launch.entry_level);
    if (!from_ids)
        argument(leaf_level());
    if (!by_groups())
        argument(launch.levels);
    queue.launch(kernel, std::size_t{launch.subtrees} * cut_.group_size, cut_.group_size,
                 moved_bytes(launch));
}

/// Children read once, nodes written once. A hand-off build does all levels in its first launch.
std::int64_t ImplicitBuilder::moved_bytes(const SubtreeLaunch& launch) const
{
    const bool from_leaves = launch.entry_level + 1 == leaf_level();
    const std::int64_t read_boxes = from_leaves ? tree_.leaves : stored_on(launch.entry_level + 1);
    const std::int64_t read_ids = from_leaves && !tree_.sorted_leaves ? tree_.leaves : 0;
    const uint last_level = handoff() ? 0 : launch.entry_level + 1 - launch.levels;
    std::int64_t written_boxes = 0;
    for (uint level = last_level; level <= launch.entry_level; ++level)
        written_boxes += stored_on(level);
    return (read_boxes + written_boxes) * std::int64_t{sizeof(Aabb)} +
           read_ids * std::int64_t{sizeof(uint)};
}

}  // namespace

std::unique_ptr<Builder> make_implicit_builder(Programs& programs, const BuilderCard& card,
                                               const ImplicitLayout& layout, Meeting meeting,
                                               const BuildOptions& options)
{
    return std::make_unique<ImplicitBuilder>(programs, card, layout, meeting, options);
}

}  // namespace bvhbench
