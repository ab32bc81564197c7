// SPDX-License-Identifier: MIT
#include "library/tree.h"

#include <algorithm>

#include "collide/counters.h"
#include "geometry/error.h"

namespace bvhbench::oibvh {
namespace {

void require_alike(const ImplicitTree& a, const ImplicitTree& b)
{
    for (const ImplicitTree* tree : {&a, &b})
        if (tree->objects.size() != 1)
            throw BadUsage("a query between trees wants trees of one object each, and one has " +
                           std::to_string(tree->objects.size()));
    if (a.sorted_leaves != b.sorted_leaves)
        throw BadUsage(
            "a query between trees wants both with sorted_leaves or both without, and one has it");
    if (std::size_t{a.leaves} + b.leaves > std::size_t{1} << 31)
        throw BadUsage("a query between trees has room for 2147483648 leaves, and they have " +
                       std::to_string(std::size_t{a.leaves} + b.leaves));
}

}  // namespace

void JoinedTrees::plan(Arena& arena, const ImplicitTree& a, const ImplicitTree& b)
{
    tree_.nodes = arena.take<std::byte>(a.nodes.bytes() + b.nodes.bytes(), Use::tree);
    tree_.leaf_boxes = arena.take<Aabb>(a.leaf_boxes.size() + b.leaf_boxes.size(), Use::tree);
    tree_.ids = arena.take<uint>(std::size_t{a.leaves} + b.leaves, Use::tree);
    tree_.device_objects = arena.take<ForestObject>(2, Use::tree);
}

void JoinedTrees::reserve(const ImplicitTree& a, const ImplicitTree& b)
{
    const std::tuple wanted(a.leaves, b.leaves, a.sorted_leaves);
    if (reserved_for_ == wanted)
        return;
    reserved_for_ = {};
    collider_.reset();  // freed before the new memory is allocated
    arena_.reset();
    tree_ = {};
    tree_.layout = a.layout;
    tree_.queue = &device_.queue;
    tree_.sorted_leaves = a.sorted_leaves;
    tree_.leaves = a.leaves + b.leaves;
    tree_.most_leaves = std::max(a.leaves, b.leaves);
    tree_.slot_count = a.slot_count + b.slot_count;
    tree_.objects = {{0, a.leaves, 0, 1}, {a.leaves, b.leaves, static_cast<uint>(a.slot_count), 1}};
    Arena measuring = Arena::measuring(device_.device);
    plan(measuring, a, b);
    arena_ = Arena::reserved(device_.device, measuring.used());
    plan(*arena_, a, b);
    tree_.device_objects.upload(device_.queue.cl(), tree_.objects);
    collider_ =
        make_(device_.programs, {.among = bvhbench::Among::between_objects, .keep_adjacent = true});
    collider_->reserve(&tree_, {});
    number_ = device_.programs.kernel("library/joined.cl", "number_behind");
    own_numbers_ = device_.programs.kernel("library/joined.cl", "own_numbers");
    reserved_for_ = wanted;
}

void JoinedTrees::enqueue_copies(const ImplicitTree& a, const ImplicitTree& b)
{
    Queue& queue = device_.queue;
    queue.begin("join");
    queue.copy(a.nodes.cl(), tree_.nodes.cl(), 0, a.nodes.bytes());
    queue.copy(b.nodes.cl(), tree_.nodes.cl(), a.nodes.bytes(), b.nodes.bytes());
    queue.copy(a.leaf_boxes.cl(), tree_.leaf_boxes.cl(), 0, a.leaf_boxes.bytes());
    queue.copy(b.leaf_boxes.cl(), tree_.leaf_boxes.cl(), a.leaf_boxes.bytes(),
               b.leaf_boxes.bytes());
    queue.copy(a.ids.cl(), tree_.ids.cl(), 0, a.ids.bytes());
    set_arguments(number_, b.ids, tree_.ids, a.leaves, b.leaves);
    device_.launch(number_, b.leaves);
}

void JoinedTrees::enqueue_own_numbers()
{
    const DevicePairs found = collider_->device_pairs(device_.queue);
    set_arguments(own_numbers_, found.pairs, found.counters, static_cast<uint>(found.pairs.size()),
                  tree_.objects.front().leaves);
    device_.launch(own_numbers_, found.pairs.size());
}

Collider& JoinedTrees::find_pairs(const ImplicitTree& a, const ImplicitTree& b)
{
    require_alike(a, b);
    reserve(a, b);
    const auto reserved = std::exchange(reserved_for_, {});  // restored on success
    enqueue_copies(a, b);
    bvhbench::find_pairs(*collider_, &tree_, {}, device_.queue);
    enqueue_own_numbers();
    reserved_for_ = reserved;
    return *collider_;
}

std::size_t JoinedTrees::memory() const
{
    return (arena_ ? arena_->used().total() : 0) + (collider_ ? collider_->reserved().total() : 0);
}

}  // namespace bvhbench::oibvh
