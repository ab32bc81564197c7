// SPDX-License-Identifier: MIT
#include "collide/walks/walk_collider.h"

#include <algorithm>

#include "geometry/bits.h"

namespace bvhbench {

WalkCollider::WalkCollider(Programs& programs, const ColliderCard& card,
                           const ColliderOptions& options, const Parameter& group_size)
    : DeviceCollider(programs, card, options, group_size)
{}

WalkCollider::Shape WalkCollider::shape() const
{
    if (by_groups())
        return {group_size_, group_size_, group_size_};
    return {device().tuned(walk_task_leaves), 0, 1};
}

cl::Kernel WalkCollider::lined_up_kernel(const DeviceTree& tree) const
{
    return kernel(tree, "collide/walks/group_chunks.cl", "group_pairs",
                  {{"TASK_LEAVES", device().tuned(walk_task_leaves)},
                   {"SKIP_OVERLAP", skips(skip_overlap) ? 1u : 0u}});
}

void WalkCollider::compile(const DeviceTree& tree)
{
    walk_ = walk_kernel(tree);
    const uint task_leaves = shape().task_leaves;
    own_list_.clear();
    for (uint k = 0; k < tree.objects.size(); ++k)
        for (uint first = 0; first < tree.objects[k].leaves; first += task_leaves)
            own_list_.push_back(
                {k, k, first, std::min(task_leaves, tree.objects[k].leaves - first)});
    most_between_ = 0;
    if (between(tree)) {
        between_kernel_ = kernel(tree, "collide/queues/between.cl", "find_between",
                                 {{"TASK_LEAVES", task_leaves},
                                  {"SKIP_APART", skips(skip_apart) ? 1u : 0u},
                                  {"SKIP_OVERLAP", skips(skip_overlap) ? 1u : 0u},
                                  {"OTHERS", others_a_work_item}});
        most_between_ = options_.capacity != 0 ? options_.capacity
                                               : std::max<std::size_t>(256, 2 * own_list_.size());
    }
}

void WalkCollider::plan(Arena& arena, const DeviceTree&)
{
    own_ = arena.take<QueryTask>(own_list_.size(), Use::scratch);
    between_ = arena.take<QueryTask>(std::max<std::size_t>(1, most_between_), Use::scratch);
    if (shape().items_a_task == 0 && has_blocks())
        blocks_ = arena.take<Pair>(block_pairs() * chunks_, Use::scratch);
}

void WalkCollider::prepare(const DeviceTree&, const cl::CommandQueue& queue)
{
    own_.upload(queue, own_list_);
}

bool WalkCollider::make_room(std::uint64_t tasks, const std::vector<std::uint64_t>&)
{
    if (tasks <= most_between_)
        return true;
    most_between_ = static_cast<std::size_t>(tasks + tasks / 8);
    return false;
}

void WalkCollider::find_between(const DeviceTree& tree, Queue& queue)
{
    set_arguments_from(between_kernel_, tree.bind(between_kernel_, 0), own_,
                       static_cast<uint>(own_.size()), static_cast<uint>(tree.objects.size()),
                       between_, static_cast<uint>(most_between_), counters_);
    const std::size_t group = by_groups() ? group_size_ : 1;
    const std::size_t items =
        own_.size() * divided_up(static_cast<uint>(tree.objects.size()), others_a_work_item);
    queue.launch(between_kernel_, by_groups() ? (items + group - 1) / group * group : chunks_,
                 group, 0);
}

void WalkCollider::enqueue(const DeviceTree& tree, const Input& input, Queue& queue)
{
    if (between(tree))
        find_between(tree, queue);
    const uint own_count = within() ? static_cast<uint>(own_.size()) : 0;
    const auto most_between = static_cast<uint>(most_between_);
    if (own_count + most_between == 0)
        return;
    const auto [leaves, items_a_task, group] = shape();
    if (items_a_task > 0 || !has_blocks())
        bind(walk_, tree, input, own_, own_count, between_, most_between);
    else
        bind(walk_, tree, input, own_, own_count, between_, most_between, blocks_);
    const std::size_t items =
        items_a_task > 0 ? (own_count + most_between_) * items_a_task : chunks_;
    queue.launch(walk_, (items + group - 1) / group * group, group, 0);
}

}  // namespace bvhbench
