// SPDX-License-Identifier: MIT
#include <algorithm>
#include <numeric>
#include <string>

#include "builders/implicit/cut.h"
#include "builders/implicit/implicit_builder.h"
#include "builders/implicit/later_subtrees.h"
#include "builders/implicit/schedule.h"
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
                   format().box_bytes());  // refuses bad options now
    }

private:
    std::unique_ptr<OrderedBuilder> twin() const override
    {
        return std::make_unique<KernelBuilder>(programs_, card(), tree_.layout, asked_, options_);
    }

    void enqueue_hierarchy(Queue& queue) override { enqueue(whole_, queue); }

    /// Where boxes are rounded into cells, those of one object are cells of all: who moves may move all of them.
    bool can_update_some() const override { return !tree_.format->has_cells(); }
    void plan_updates(Arena& arena) override
    {
        update_.subtrees = arena.take<cl_uint2>(whole_.subtree_list.size(), Use::scratch);
        update_.later = arena.take<LaterSubtree>(whole_.later_list.size(), Use::scratch);
    }
    void begin_update(const cl::CommandQueue& queue, std::span<const TreeUpdate> updates) override;
    void enqueue_update(Queue& queue) override { enqueue(update_, queue); }

    bool in_one_launch() const { return meeting_ != Meeting::between_launches; }
    bool waits() const { return meeting_ == Meeting::by_waiting; }
    bool by_groups() const { return cut_.form == KernelForm::groups; }

    /// The kernel that reads `from` ids or nodes, of groups as `cut` says.
    cl::Kernel kernel(const Cut& cut, const char* from) const
    {
        const std::string text = std::string(is_forest() ? "forest_" : "") +
                                 (waits()           ? "waiting_"
                                  : in_one_launch() ? "single_"
                                  : is_forest()     ? ""
                                                    : "multi_") +
                                 from;
        const Define boxes{"BOX_FORMAT", tree_.format->number};
        if (!by_groups())
            return programs_.kernel(tree_.layout.build_items, text.c_str(), {boxes});
        return programs_.kernel(
            tree_.layout.build_groups, text.c_str(),
            {boxes, {"GROUP_SIZE", cut.group_size}, {"ITEMS", cut.items}, {"LEVELS", cut.levels}},
            in_one_launch() ? Optimise::on_gpus
                            : Optimise::freely);  // groups return before a barrier
    }

    /// One launch, of all objects: those whose trees are so high take part in it.
    struct Launch {
        uint first_subtree = 0, subtrees = 0;  ///< of the list; later ones are not among them
        SubtreeLaunch of_first;                ///< how the first object's tree takes part
        std::int64_t moved_bytes = 0;
    };

    /// The launches that make the trees of all objects, or of some.
    struct Launches {
        std::vector<Launch> list;
        /// Object and position, launch by launch; of several objects only.
        std::vector<cl_uint2> subtree_list;
        Buffer<cl_uint2> subtrees;
        std::vector<LaterSubtree>
            later_list;  ///< where groups wait: those of all but the first round
        Buffer<LaterSubtree> later;
    };

    void plan_hierarchy(Arena& arena) override;
    void plan_launches(Launches& launches, std::span<const uint> objects) const;
    bool may_wait() const;
    bool fits(const Cut& cut) const;
    void choose_and_plan(Meeting meeting);
    void prepare(const cl::CommandQueue& queue) override;
    void enqueue(const Launches& launches, Queue& queue);
    void launch(const Launches& launches, uint index, Queue& queue);
    std::int64_t moved_bytes(uint leaves, const SubtreeLaunch& launch) const;

    const Meeting asked_;
    Meeting meeting_;
    Cut cut_;
    cl::Kernel from_ids_, from_nodes_;
    Launches whole_, update_;
    /// Hand-off only: one a node above the first launch's subtrees, or one a slot.
    Buffer<uint> arrivals_;
    Buffer<cl_ulong> posts_;  ///< if groups wait: a box a group
};

/// POSTS_A_BOX of build_waiting.clh, where nothing posted is a word of ones.
std::size_t words_per_post(const BoxFormat& format) { return format.number == BOX_F64 ? 6 : 3; }

/// A CPU takes groups in order, so that whom a group waits for has begun; it is asked to in tests only.
bool KernelBuilder::may_wait() const
{
    const Device& device = programs_.device();
    return asked_ == Meeting::by_handoff && (device.lets_groups_wait() || device.is_cpu()) &&
           device.tuned(implicit_waits) != 0;
}

/// Whether the device has the local memory that the kernels need. Boxes that take at most half of it fit for sure, since
/// compilers add only a few bytes; else the kernels are compiled to find out.
bool KernelBuilder::fits(const Cut& cut) const
{
    const std::size_t local = programs_.device().cl.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>();
    if (2 * local_box_bytes(cut, tree_.format->box_bytes()) <= local)
        return true;
    try {
        kernel(cut, "from_ids");
        kernel(cut, "from_nodes");
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
    plan_launches(whole_, all);
}

void KernelBuilder::plan_hierarchy(Arena& arena)
{
    choose_and_plan(may_wait() ? Meeting::by_waiting : asked_);
    // Those that wait leave at least one unit to those they wait for, in whatever order groups start.
    const Device& device = programs_.device();
    if (!device.is_cpu() &&
        whole_.later_list.size() >= device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>())
        choose_and_plan(asked_);
    whole_.subtrees = arena.take<cl_uint2>(whole_.subtree_list.size(), Use::scratch);
    whole_.later = arena.take<LaterSubtree>(whole_.later_list.size(), Use::scratch);
    const std::size_t groups =
        whole_.list.empty() ? 0 : whole_.list[0].subtrees + whole_.later_list.size();
    posts_ =
        arena.take<cl_ulong>(waits() ? words_per_post(*tree_.format) * groups : 0, Use::scratch);

    std::size_t above = 0;
    if (meeting_ == Meeting::by_handoff && is_forest())
        above = tree_.slot_count;
    else if (meeting_ == Meeting::by_handoff && !whole_.list.empty())
        above = tree_.layout.first_slot(
            tree_.leaves, whole_.list[0].of_first.entry_level + 1 - whole_.list[0].of_first.levels);
    arrivals_ = arena.take<uint>(above, Use::scratch);
}

void KernelBuilder::plan_launches(Launches& launches, std::span<const uint> objects) const
{
    launches.list.clear();
    launches.subtree_list.clear();
    std::vector<SubtreeSchedule> schedules;
    for (const uint object : objects) {
        const uint leaves = tree_.objects[object].leaves;
        schedules.push_back(
            subtree_schedule(implicit_leaf_level(leaves), cut_.levels,
                             [&](uint level) { return tree_.layout.stored_on(leaves, level); }));
    }
    uint count = 0;
    for (const SubtreeSchedule& schedule : schedules)
        count = std::max(count, in_one_launch() ? std::min(schedule.count, 1u) : schedule.count);
    for (uint k = 0; k < count; ++k) {
        Launch launch{static_cast<uint>(launches.subtree_list.size()), 0, schedules[0].launches[k],
                      0};
        for (std::size_t chosen = 0; chosen < objects.size(); ++chosen) {
            if (k >= schedules[chosen].count)
                continue;
            const uint object = objects[chosen];
            const SubtreeLaunch& part = schedules[chosen].launches[k];
            launch.subtrees += part.subtrees;
            launch.moved_bytes += moved_bytes(tree_.objects[object].leaves, part);
            for (uint position = 0; is_forest() && position < part.subtrees; ++position)
                launches.subtree_list.push_back({{object, position}});
        }
        launches.list.push_back(launch);
    }
    launches.later_list.clear();
    if (waits())
        launches.later_list = later_subtrees(objects, schedules);
}

void KernelBuilder::begin_update(const cl::CommandQueue& queue, std::span<const TreeUpdate> updates)
{
    std::vector<uint> objects;
    for (uint object = 0; object < updates.size(); ++object)
        if (updates[object] != TreeUpdate::keep)
            objects.push_back(object);
    plan_launches(update_, objects);
    update_.subtrees.upload(queue, update_.subtree_list);
    update_.later.upload(queue, update_.later_list);
}

void KernelBuilder::enqueue(const Launches& launches, Queue& queue)
{
    for (uint k = 0; k < launches.list.size(); ++k)
        launch(launches, k, queue);
}

void KernelBuilder::prepare(const cl::CommandQueue& queue)
{
    ImplicitBuilder::prepare(queue);
    from_ids_ = kernel(cut_, "from_ids");
    from_nodes_ = kernel(cut_, "from_nodes");
    arrivals_.upload(queue, std::vector<uint>(arrivals_.size(), 0u));
    posts_.upload(queue, std::vector<cl_ulong>(posts_.size(), ~cl_ulong{0}));
    whole_.subtrees.upload(queue, whole_.subtree_list);
    whole_.later.upload(queue, whole_.later_list);
}

void KernelBuilder::launch(const Launches& launches, uint k, Queue& queue)
{
    const Launch& launch = launches.list[k];
    const bool from_ids = k == 0 && !tree_.sorted_leaves;
    cl::Kernel& kernel = from_ids ? from_ids_ : from_nodes_;
    cl_uint index = 0;
    const auto argument = [&](const auto& value) { kernel.setArg(index++, memory_of(value)); };
    if (from_ids) {
        argument(tree_.leaf_boxes);
        argument(tree_.ids);
    }
    argument(tree_.nodes);
    if (waits()) {
        argument(posts_);
        argument(launches.later);
    } else if (in_one_launch()) {
        argument(arrivals_);
    }
    if (is_forest()) {
        argument(tree_.device_objects);
        argument(launches.subtrees);
        if (!from_ids && !in_one_launch()) {
            argument(launch.first_subtree);
            argument(k);
        }
        if (!by_groups())
            argument(cut_.levels);
    } else {
        argument(tree_.leaves);
        argument(launch.of_first.entry_level);
        if (!from_ids)
            argument(implicit_leaf_level(tree_.leaves));
        if (!by_groups())
            argument(launch.of_first.levels);
    }
    if (waits())
        argument(launch.subtrees);
    queue.launch(kernel, (launch.subtrees + launches.later_list.size()) * cut_.group_size,
                 cut_.group_size, launch.moved_bytes);
}

/// Children read once, nodes written once. A hand-off build does all levels in its first launch.
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
