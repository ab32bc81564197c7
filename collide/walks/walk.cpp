// SPDX-License-Identifier: MIT
//
// Colliders that find all pairs in one launch: tasks of neighbouring leaves, each tested against the tree of one object.
#include <algorithm>

#include "collide/counters.h"
#include "collide/device_collider.h"
#include "collide/device_lists.h"
#include "collide/first_contact.h"
#include "collide/object_order.h"
#include "collide/parameters.h"
#include "collide/walks/collapse.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

/// By how much the common box of leaves of `block` may exceed them, as group.loose. On an H200, 2 takes 3 to 9 % longer over
/// hilbert30.
constexpr uint block_loose = 4;

/// Blocks of leaves a compute unit up to which two teams of `block` share a task: then the longest walks decide. On an H200 4,502 blocks
/// of a torus take 36.4 µs with two and 37.5 with one; 90,000 take 494 and 351.
constexpr std::size_t most_shared_per_unit = 40;

/// Leaves of a tree that are not in its order: line_up.cl counts places behind the numbers of inner nodes in 31 bits.
constexpr uint most_lined_up = 1u << 30;

/// Pairs that a work-item of `leaf` buffers in the form for few cores: half of its fastest cache.
constexpr uint leaf_block_pairs = 512;

enum class By { leaf, group, block };

constexpr ColliderCard cards[] = {
    {"leaf", "Leaf against tree, without a stack [Prokopenko2024]"},
    {"group", "Neighbouring leaves as one query [Chitalu2020, Eq. 12]"},
    {"block", "Blocks of leaves against blocks [Chitalu2020, Eq. 12]"},
};

class Walk final : public DeviceCollider {
public:
    Walk(Programs& programs, const ColliderOptions& options, By by)
        : DeviceCollider(programs, cards[static_cast<int>(by)], options,
                         by == By::leaf ? leaf_group_size : group_group_size,
                         by == By::block && is_by_groups(programs, options)
                             ? Wants::tree
                             : Wants::tree_with_ropes)
        , by_(by)
    {}

    bool finds_contacts() const override { return options_.first; }

    QueryCounts counts(const Queue& queue) const override
    {
        QueryCounts counts = DeviceCollider::counts(queue);
        if (first_)
            counts.box_tests.reset();  // their number depends on when a contact is seen
        return counts;
    }

private:
    std::string objection(const DeviceTree& tree) const override
    {
        if (by_ == By::block && !tree.is_in_order() && tree.leaf_count() > most_lined_up)
            return "block lines up " + std::to_string(most_lined_up) + " leaves at most, not " +
                   std::to_string(tree.leaf_count());
        return {};
    }

    bool follows_pointers(const DeviceTree& tree) const override { return !tree.is_implicit(); }

    static bool is_by_groups(Programs& programs, const ColliderOptions& options)
    {
        return chosen_form(programs.device(), options.form) == KernelForm::groups;
    }

    void compile(const Input& input) override
    {
        if (by_groups())
            compile_groups();
        else
            compile_chunks();
        own_list_.clear();
        for (uint k = 0; k < object_count(); ++k)
            for (uint first = 0; first < tree().objects[k].leaves; first += task_leaves_)
                own_list_.push_back(
                    {k, k, first, std::min(task_leaves_, tree().objects[k].leaves - first)});
        const auto excluded = std::ranges::stable_partition(own_list_, [&](const QueryTask& task) {
            return options_.filter.allows(task.own, task.own);
        });
        within_count_ = static_cast<uint>(own_list_.size() - excluded.size());
        between_room_ = 0;
        order_.reset();
        if (!between(object_count()))
            return;
        order_ = object_order(input);
        std::vector<Define> defines = {{"GROUP_SIZE", by_groups() ? group_size_ : 1u},
                                       {"TASK_LEAVES", task_leaves_},
                                       {"SWEEP_LANES", by_groups() ? ObjectOrder::lanes : 1u},
                                       {"SKIP_APART", skips(skip_apart) ? 1u : 0u},
                                       {"SKIP_OVERLAP", skips(skip_overlap) ? 1u : 0u}};
        if (is_filtered())
            defines.push_back({"FILTERED", 1u});
        between_kernel_ =
            kernel(order_ ? "collide/queues/many_between.cl" : "collide/queues/between.cl",
                   order_ ? "sweep_between" : "find_between", defines);
        between_room_ =
            first_room(std::max<std::size_t>(256, 2 * own_list_.size()), sizeof(QueryTask));
    }

    /// One work-group per task; for `block`, one team or two.
    void compile_groups()
    {
        task_leaves_ = group_size_;
        items_a_task_ = launch_group_ = group_size_;
        if (options_.first) {
            compile_first({{"GROUP_SIZE", group_size_}}, Optimise::on_gpus);
        } else if (by_ == By::leaf) {
            walk_ = kernel("collide/walks/leaf_groups.cl", "leaf_pairs",
                           {{"GROUP_SIZE", group_size_}}, Optimise::on_gpus);
        } else if (by_ == By::group) {
            compile_group();
        } else {
            const bool has_warps = device().lets_groups_wait();
            const uint teams = has_warps ? device().tuned(block_teams) : 1;
            task_leaves_ = BLOCK_LEAVES;
            const uint lanes = has_warps ? TEAM_LANES : 1;
            const bool shares =
                divided_up(tree().leaf_count(), BLOCK_LEAVES) <=
                most_shared_per_unit * device().cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
            const uint teams_a_task = shares ? 2 : 1;
            items_a_task_ = std::size_t{teams_a_task} * lanes;
            launch_group_ = std::size_t{teams} * lanes;
            zeroes_next_ = true;
            collapse_.reset();
            if ((!tree().is_implicit() || tree().child_bits() > 1) && tree().leaf_count() > 1)
                collapse_.emplace(programs(), tree(), options_.capacity);
            queue_count_ = collapse_ ? 1 : 0;  // CHILDREN_COUNT
            walk_ = kernel("collide/walks/block.cl", "block_pairs",
                           {{"TEAMS", teams},
                            {"LOOSE", block_loose},
                            {"TEAMS_A_TASK", teams_a_task},
                            {"CLASSES", collapse_ ? collapse_->classes() : 1}},
                           Optimise::on_gpus);
        }
    }

    void compile_group()
    {
        // Reserve for the descent from the last node: in a binary tree, one node more than there are levels; in a wide tree, all
        // children of a node per level. A query starts with at most one node per level, so twice that suffices; more is for
        // speed.
        const bool is_wide = tree().child_bits() > 1;
        const uint levels = tree().most_levels();
        const uint reserve = (is_wide ? levels << tree().child_bits() : levels) + 1;
        const uint more =
            is_wide ? wide_frontier_per_item : device().tuned(group_frontier_per_item);
        walk_ =
            kernel(is_wide ? "collide/walks/group_wide_groups.cl" : "collide/walks/group_groups.cl",
                   "group_pairs",
                   {{"GROUP_SIZE", group_size_},
                    {"FRONTIER", 2 * reserve + (options_.capacity != 0 ? 0 : more * group_size_)},
                    {"RESERVE", reserve},
                    {"LOOSE", device().tuned(group_loose)}},
                   Optimise::on_gpus);
    }

    /// A few work-items share all tasks. For `leaf`, each takes a contiguous run of tasks and collects pairs in a block;
    /// otherwise each takes tasks from a counter, and `block` runs as `group`.
    void compile_chunks()
    {
        task_leaves_ = device().tuned(walk_task_leaves);
        items_a_task_ = 0;
        launch_group_ = 1;
        if (options_.first) {
            compile_first({}, Optimise::freely);
        } else if (by_ == By::leaf) {
            block_pairs_ = leaf_block_pairs;
            walk_ = kernel("collide/walks/leaf_chunks.cl", "leaf_pairs",
                           {{"SINK_BLOCK", block_pairs_}});
        } else {
            queue_count_ = 1;  // room for TASKS_BEGUN
            walk_ = kernel(
                "collide/walks/group_chunks.cl", "group_pairs",
                {{"TASK_LEAVES", task_leaves_}, {"SKIP_OVERLAP", skips(skip_overlap) ? 1u : 0u}});
        }
    }

    void compile_first(std::vector<Define> defines, Optimise optimise)
    {
        first_.emplace(programs(), options_, group_size_,
                       first_room(std::max<std::size_t>(1024, triangles_)));
        queue_count_ = 1;  // UNSURE_COUNT
        defines.push_back(first_->define());
        walk_ = kernel("collide/first/first_contact.cl", "find_first", defines, optimise);
    }

    void plan(Arena& arena) override
    {
        if (first_)
            first_->plan(arena);
        own_ = arena.take<QueryTask>(own_list_.size(), Use::scratch);
        if (collapse_)
            collapse_->plan(arena);
        between_ = arena.take<QueryTask>(std::max<std::size_t>(1, between_room_), Use::scratch);
        if (order_)
            order_->plan(arena, tree());
        if (block_pairs_ > 0)
            blocks_ = arena.take<Pair>(block_pairs_ * chunks_, Use::scratch);
    }

    void fill(const cl::CommandQueue& queue) override
    {
        own_.upload(queue, own_list_);
        if (order_)
            order_->prepare(queue);
        if (collapse_)
            collapse_->prepare(queue);
    }

    bool make_room(std::uint64_t tasks, const std::vector<std::uint64_t>& queues) override
    {
        const bool has_children = !collapse_ || collapse_->had_room_for(queues.front());
        const bool has_unsure = !first_ || first_->make_room(queues.front());
        return had_room(between_room_, tasks, tasks / 8, sizeof(QueryTask), device(), "tasks") &&
               has_children && has_unsure;
    }

    void enqueue_before(const Input&, Queue& queue) override
    {
        if (collapse_)
            collapse_->enqueue(tree(), queue);
    }

    void enqueue(const Input& input, Queue& queue) override
    {
        const auto own_count = static_cast<uint>(own_.size());
        const auto between_room = static_cast<uint>(between_room_);
        if (order_) {
            order_->enqueue(tree(), queue);
            order_->bind(between_kernel_, tree().bind(between_kernel_, 0), own_, own_count,
                         between_, between_room, counters_);
            launch(between_kernel_, by_groups() ? ObjectOrder::lanes * own_.size() : chunks_,
                   by_groups() ? group_size_ : 1, queue);
        } else if (between(object_count())) {
            set_arguments_from(between_kernel_, tree().bind(between_kernel_, 0), own_, own_count,
                               object_count(), between_, between_room, counters_);
            const std::size_t items = own_.size() * divided_up(object_count(), OTHERS_AT_A_TIME);
            launch(between_kernel_, by_groups() ? items : chunks_, by_groups() ? group_size_ : 1,
                   queue);
        }
        const uint tasks_within = within() ? within_count_ : 0;
        if (tasks_within + between_room == 0)
            return;
        if (first_)
            bind(walk_, input, own_, tasks_within, between_, between_room, input.device_points,
                 first_->unsure(), first_->room());
        else if (block_pairs_ > 0)
            bind(walk_, input, own_, tasks_within, between_, between_room, blocks_);
        else if (collapse_)
            bind(walk_, input, own_, tasks_within, between_, between_room, next_counters_,
                 static_cast<uint>(next_counters_.size()), collapse_->children(),
                 collapse_->child_ends(), collapse_->roots(), collapse_->child_count(),
                 collapse_->room(), collapse_->places());
        else if (zeroes_next_)
            bind(walk_, input, own_, tasks_within, between_, between_room, next_counters_,
                 static_cast<uint>(next_counters_.size()));
        else
            bind(walk_, input, own_, tasks_within, between_, between_room);
        const std::size_t tasks = tasks_within + between_room_;
        launch(walk_, items_a_task_ > 0 ? tasks * items_a_task_ : chunks_, launch_group_, queue);
        if (first_)
            first_->decide(input, pairs_, counters_, queue);
    }

    static constexpr uint wide_frontier_per_item = 4;

    By by_;
    uint task_leaves_ = 0;                             ///< most leaves of a task; a power of two
    std::size_t items_a_task_ = 0, launch_group_ = 1;  ///< in work-items; 0: all share all tasks
    uint block_pairs_ = 0;                             ///< pairs that a work-item buffers; 0: none
    cl::Kernel walk_, between_kernel_;
    std::unique_ptr<ObjectOrder> order_;  ///< of many objects
    std::vector<QueryTask> own_list_;     ///< tasks of each object against its own tree
    uint within_count_ = 0;               ///< how many of them are wanted, the first ones
    std::size_t between_room_ = 0;        ///< capacity of between_, in tasks
    std::optional<Collapse> collapse_;    ///< of `block` over what is not implicit and binary
    std::optional<FirstContact> first_;   ///< of `leaf` up to the first contact
    Buffer<QueryTask> own_;
    Buffer<QueryTask> between_;
    Buffer<Pair> blocks_;
};

}  // namespace

std::unique_ptr<Collider> make_leaf(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Walk>(programs, options, By::leaf);
}

std::unique_ptr<Collider> make_group(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Walk>(programs, options, By::group);
}

std::unique_ptr<Collider> make_block(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Walk>(programs, options, By::block);
}

}  // namespace bvhbench
