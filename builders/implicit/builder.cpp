// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numeric>
#include <string>

#include "builders/implicit/cut.h"
#include "builders/implicit/implicit_builder.h"
#include "builders/implicit/launches.h"
#include "builders/parameters.h"
#include "geometry/error.h"

namespace bvhbench {
namespace {

class KernelBuilder final : public ImplicitBuilder {
public:
    KernelBuilder(Programs& programs, const BuilderCard& card, const ImplicitLayout& layout,
                  Meeting meeting, const BuildOptions& options)
        : ImplicitBuilder(programs, card, layout, options), asked_(meeting), meeting_(meeting)
    {
        choose_cut(programs.device(), options, meeting, 1,
                   format().box_bytes());  // throws for bad options now
    }

private:
    std::unique_ptr<OrderedBuilder> twin() const override
    {
        return std::make_unique<KernelBuilder>(programs_, card(), tree_.layout, asked_, options_);
    }

    void enqueue_hierarchy(Queue& queue) override { enqueue(whole_, queue, 0); }

    /// A group kernel can line up leaves; a tree that is one leaf has no group.
    bool lines_up() const override
    {
        return by_groups() && tree_.sorted_leaves && tree_.format->number == BOX_F32 &&
               std::ranges::all_of(tree_.objects,
                                   [](const ForestObject& object) { return object.leaves > 1; });
    }
    void enqueue_lining_up(Queue& queue) override { enqueue(whole_, queue, tree_.leaves); }

    /// If boxes are rounded to cells, the cells depend on all objects, so one moved object may change the boxes of all.
    bool can_update_some() const override { return !tree_.format->has_cells(); }
    void plan_updates(Arena& arena) override { update_.take(arena, whole_); }
    void begin_update(const cl::CommandQueue& queue, std::span<const uint> objects) override
    {
        update_.plan(objects, launch_plan());
        update_.upload(queue);
    }
    void enqueue_update(Queue& queue) override
    {
        enqueue(update_, queue, lines_up() ? leaf_order_.updated().triangles() : 0);
    }

    bool in_one_launch() const { return meeting_ != Meeting::between_launches && !is_printed(); }
    bool is_printed() const { return meeting_ == Meeting::by_local_atomics; }
    bool waits() const { return meeting_ == Meeting::by_waiting; }
    bool climbs() const { return meeting_ == Meeting::by_climbing; }
    bool by_groups() const { return cut_.form == KernelForm::groups; }

    /// Returns the group kernel for `cut`, or the work-item kernel, that reads leaves in mesh order (`from_leaves`) or nodes.
    cl::Kernel kernel(const Cut& cut, bool from_leaves) const
    {
        const char* name = waits()                       ? "waiting"
                           : climbs() && by_groups()     ? "climbing"
                           : is_printed() && by_groups() ? "meeting"
                           : in_one_launch()             ? "single"
                                                         : "multi";
        std::vector<Define> defines = {{"BOX_FORMAT", tree_.format->number},
                                       {"FROM_LEAVES", from_leaves ? 1u : 0u},
                                       {"LINES_UP", from_leaves && tree_.sorted_leaves ? 1u : 0u},
                                       {"SEVERAL_OBJECTS", is_forest() ? 1u : 0u}};
        if (!by_groups())
            return programs_.kernel(tree_.layout.build_items, name, defines);
        defines.insert(
            defines.end(),
            {{"GROUP_SIZE", cut.group_size}, {"ITEMS", cut.items}, {"LEVELS", cut.levels}});
        return programs_.kernel(tree_.layout.build_groups, name, defines,
                                in_one_launch()
                                    ? Optimise::on_gpus
                                    : Optimise::freely);  // groups may return before a barrier
    }

    void plan_hierarchy(Arena& arena) override;
    LaunchPlan launch_plan() const;
    bool may_wait() const;
    bool fits(const Cut& cut) const;
    void choose_and_plan(Meeting meeting);
    void prepare(const cl::CommandQueue& queue) override;
    void enqueue(const Launches& launches, Queue& queue, std::size_t lined_up);
    std::int64_t moved_bytes(uint leaves, const SubtreeLaunch& launch) const;

    const Meeting asked_;
    Meeting meeting_;
    Cut cut_;
    cl::Kernel from_leaves_, from_nodes_;
    Launches whole_, update_;
    /// By_handoff and by_climbing: one per slot, up to those of the last tree's first subtree roots.
    Buffer<uint> arrivals_;
    Buffer<cl_ulong> posts_;  ///< If groups wait: a box per group.
};

/// Returns POSTS_A_BOX of build_waiting.clh, in which an empty post is a word with all bits set.
std::size_t words_per_post(const BoxFormat& format) { return format.number == BOX_F64 ? 6 : 3; }

/// True if groups may wait for each other. A CPU runs groups in order, so those that a group waits for have started; waiting is
/// chosen there in tests only.
bool KernelBuilder::may_wait() const
{
    const Device& device = programs_.device();
    return asked_ == Meeting::by_handoff && (device.lets_groups_wait() || device.is_cpu()) &&
           device.tuned(implicit_waits) != 0;
}

/// True if the kernels' local memory fits on the device. Boxes that take at most half of it always fit, because compilers add
/// only a few bytes; otherwise the kernels are compiled to find out.
bool KernelBuilder::fits(const Cut& cut) const
{
    const std::size_t local = programs_.device().cl.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>();
    if (2 * local_box_bytes(cut, tree_.format->box_bytes()) <= local)
        return true;
    try {
        kernel(cut, true);
        kernel(cut, false);
        return true;
    } catch (const Unavailable&) {
        return false;
    }
}

void KernelBuilder::choose_and_plan(Meeting meeting)
{
    cut_ = choose_cut(programs_.device(), options_, meeting, tree_.most_leaves,
                      tree_.format->box_bytes());
    meeting_ = by_groups() ? meeting : asked_;
    if (by_groups() && options_.group_size == 0)
        cut_ = cut_that_fits(cut_, [&](const Cut& cut) { return fits(cut); });
    std::vector<uint> all(tree_.objects.size());
    std::iota(all.begin(), all.end(), 0u);
    whole_.plan(all, launch_plan());
}

void KernelBuilder::plan_hierarchy(Arena& arena)
{
    choose_and_plan(may_wait() ? Meeting::by_waiting : asked_);
    // The waiting groups must leave at least one compute unit to the groups they wait for, whatever the order of starting. Where there
    // are more, a launch a round takes less time than groups that each find out whether they are the last.
    const Device& device = programs_.device();
    if (!device.is_cpu() &&
        whole_.later_list.size() >= device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>())
        choose_and_plan(Meeting::between_launches);
    whole_.take(arena, whole_);
    const std::size_t groups =
        whole_.list.empty() ? 0 : whole_.list[0].subtrees + whole_.later_list.size();
    posts_ =
        arena.take<cl_ulong>(waits() ? words_per_post(*tree_.format) * groups : 0, Use::scratch);

    const ForestObject& last = tree_.objects.back();
    const uint leaf_level = implicit_leaf_level(last.leaves);
    const uint root_level = leaf_level - std::min(leaf_level, cut_.levels);
    arrivals_ = arena.take<uint>(in_one_launch() && !waits()
                                     ? last.nodes + tree_.layout.first_slot(last.leaves, root_level)
                                     : 0,
                                 Use::scratch);
}

LaunchPlan KernelBuilder::launch_plan() const
{
    return {.objects = tree_.objects,
            .schedule =
                [this](uint leaves) {
                    return subtree_schedule(
                        implicit_leaf_level(leaves), cut_.levels,
                        [&](uint level) { return tree_.layout.stored_on(leaves, level); });
                },
            .moved_bytes = std::bind_front(&KernelBuilder::moved_bytes, this),
            .in_one_launch = in_one_launch(),
            .waits = waits()};
}

void KernelBuilder::prepare(const cl::CommandQueue& queue)
{
    ImplicitBuilder::prepare(queue);
    if (!tree_.sorted_leaves || lines_up())
        from_leaves_ = kernel(cut_, true);
    if (tree_.sorted_leaves || !in_one_launch())
        from_nodes_ = kernel(cut_, false);
    arrivals_.upload(queue, std::vector<uint>(arrivals_.size(), 0u));
    posts_.upload(queue, std::vector<cl_ulong>(posts_.size(), ~cl_ulong{0}));
    whole_.upload(queue);
}

/// If leaves are to be lined up, as many as are given, the first launch reads them in mesh order and writes them in leaf order, too.
void KernelBuilder::enqueue(const Launches& launches, Queue& queue, std::size_t lined_up)
{
    for (uint k = 0; k < launches.list.size(); ++k) {
        const Launch& launch = launches.list[k];
        cl::Kernel& kernel =
            k == 0 && (lined_up > 0 || !tree_.sorted_leaves) ? from_leaves_ : from_nodes_;
        cl_uint next = set_arguments_from(kernel, 0, leaf_order_.boxes(), tree_.ids, tree_.nodes,
                                          tree_.device_objects, launches.subtrees, tree_.leaves);
        if (waits())
            next = set_arguments_from(kernel, next, posts_, launches.later, launch.subtrees);
        else if (in_one_launch())
            next = set_arguments_from(kernel, next, arrivals_);
        else
            next = set_arguments_from(kernel, next, launch.first_subtree, k);
        if (!by_groups())
            set_arguments_from(kernel, next, cut_.levels);
        if (k == 0)  // ids are read and leaves written, too
            queue.declare(static_cast<std::int64_t>(lined_up * (sizeof(uint) + sizeof(Aabb))));
        queue.launch(kernel, (launch.subtrees + launches.later_list.size()) * cut_.group_size,
                     cut_.group_size, launch.moved_bytes);
    }
}

/// Returns the bytes moved: children read once, nodes written once. A build in one launch has all levels in it.
std::int64_t KernelBuilder::moved_bytes(uint leaves, const SubtreeLaunch& launch) const
{
    const auto stored_on = [&](uint level) { return tree_.layout.stored_on(leaves, level); };
    const bool from_leaves = launch.entry_level + 1 == implicit_leaf_level(leaves);
    const std::int64_t read_boxes = from_leaves ? leaves : stored_on(launch.entry_level + 1);
    const std::int64_t read_ids = from_leaves && !tree_.sorted_leaves ? leaves : 0;
    const uint last_level = in_one_launch() ? 0 : launch.entry_level + 1 - launch.levels;
    std::int64_t written_boxes = 0;
    for (uint level = last_level; level <= launch.entry_level; ++level)
        written_boxes += stored_on(level);
    return (read_boxes + written_boxes) * static_cast<std::int64_t>(tree_.format->box_bytes()) +
           read_ids * std::int64_t{sizeof(uint)};
}

}  // namespace

std::unique_ptr<Builder> make_implicit_builder(Programs& programs, const BuilderCard& card,
                                               const ImplicitLayout& layout, Meeting meeting,
                                               const BuildOptions& options)
{
    return std::make_unique<KernelBuilder>(programs, card, layout, meeting, options);
}

}  // namespace bvhbench
