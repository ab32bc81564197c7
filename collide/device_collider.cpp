// SPDX-License-Identifier: MIT
#include "collide/device_collider.h"

#include <cassert>

#include "collide/counters.h"
#include "geometry/bits.h"
#include "geometry/error.h"

namespace bvhbench {

DeviceCollider::DeviceCollider(Programs& programs, const ColliderCard& card,
                               const ColliderOptions& options, const Parameter& group_size)
    : PairCollider(programs, card, options, group_size)
{}

std::string DeviceCollider::refusal(const Tree& tree) const
{
    const auto* on_device = dynamic_cast<const DeviceTree*>(&tree);
    if (on_device == nullptr)
        return std::string(card().name) + " needs a tree in device memory";
    if (has_ropes(*on_device) && device().ends_loops)
        return std::string(card().name) + " follows pointers of a tree in loops that " +
               device().name() + " ends early";
    return {};
}

cl::Kernel DeviceCollider::kernel(const DeviceTree& tree, std::string_view path, const char* name,
                                  std::vector<Define> more, Optimise optimise) const
{
    more.push_back({"SORTED_LEAVES", tree.has_sorted_leaves() ? 1u : 0u});
    more.push_back({"BOX_FORMAT", tree.box_format().number});
    more.push_back({"KEEP_ADJACENT", options_.keep_adjacent ? 1u : 0u});
    return programs().kernel(tree.access_header(), path, name, more, optimise);
}

void DeviceCollider::reserve(const Tree* tree, const Input&)
{
    assert(tree != nullptr);
    if (const std::string why = refusal(*tree); !why.empty())
        throw BadUsage(why);
    tree_ = dynamic_cast<const DeviceTree*>(tree);
    compile(*tree_);
    if (has_ropes(*tree_))
        ropes_kernel_ = kernel(*tree_, "collide/walks/ropes.cl", "ropes", {});
    take_memory_for(tree_->leaf_count());
}

void DeviceCollider::plan_rest(Arena& arena)
{
    ropes_ = arena.take<uint>(has_ropes(*tree_) ? 2 * std::size_t{tree_->leaf_count()} - 1 : 1,
                              Use::scratch);
    plan(arena, *tree_);
}

void DeviceCollider::enqueue_ropes(const DeviceTree& tree, Queue& queue)
{
    const std::size_t group = by_groups() ? group_size_ : 1;
    const std::size_t items =
        by_groups() ? divided_up(tree.leaf_count(), group_size_) * group : chunks_;
    set_arguments_from(ropes_kernel_, tree.bind(ropes_kernel_, 0), ropes_);
    queue.begin("ropes");
    queue.launch(
        ropes_kernel_, items, group,
        2 * static_cast<std::int64_t>(ropes_.bytes()));  // each child read, each rope written
}

void DeviceCollider::query(const Tree* tree, const Input& input, Queue& queue)
{
    const auto& on_device = dynamic_cast<const DeviceTree&>(*tree);
    assert(tree_ != nullptr && on_device.leaf_count() == tree_->leaf_count());
    const bool has_pairs = on_device.leaf_count() > 1;
    if (has_ropes(on_device) && has_pairs)
        enqueue_ropes(on_device, queue);
    queue.begin("broad");
    queue.clear(counters_.cl(), counters_.bytes());
    queue.declare(has_pairs ? reads_at_least(on_device) : 0);
    if (has_pairs)
        enqueue(on_device, input, queue);
}

std::int64_t DeviceCollider::reads_at_least(const DeviceTree& tree) const
{
    if (!within())  // of trees that are apart from all others hardly anything is read
        return 0;
    const std::int64_t leaves = tree.leaf_count();
    const std::int64_t nodes = 2 * leaves - std::ssize(tree.objects);
    return nodes * static_cast<std::int64_t>(tree.box_format().box_bytes()) +
           leaves * std::int64_t{sizeof(uint)};
}

QueryCounts DeviceCollider::counts(const Queue& queue) const
{
    QueryCounts result = PairCollider::counts(queue);
    if (tree_->objects.size() > 1)
        result.tasks = counters(queue)[TASKS_COUNT / 2];
    return result;
}

}  // namespace bvhbench
