// SPDX-License-Identifier: MIT
#include "builders/implicit/implicit_builder.h"

#include <algorithm>
#include <numeric>

namespace bvhbench {

ImplicitBuilder::ImplicitBuilder(Programs& programs, const BuilderCard& card,
                                 const ImplicitLayout& layout, const BuildOptions& options)
    : OrderedBuilder(programs, card, options)
{
    tree_.layout = layout;
    tree_.sorted_leaves = options.sorted_leaves;
    tree_.format = &format();
}

void ImplicitBuilder::plan(Arena& arena, std::span<const uint> sizes)
{
    const uint primitives = std::accumulate(sizes.begin(), sizes.end(), 0u);
    tree_.leaves = primitives;
    tree_.most_leaves = *std::max_element(sizes.begin(), sizes.end());
    tree_.objects.clear();
    std::size_t slots = 0, padding = 0;
    uint first = 0;
    for (const uint size : sizes) {
        tree_.objects.push_back({first, size, static_cast<uint>(slots), 1});
        slots += tree_.slots(size);
        padding += tree_.layout.stored_on(size, implicit_leaf_level(size)) - size;
        first += size;
    }

    tree_.slot_count = slots;
    tree_.nodes = arena.take<std::byte>(slots * tree_.format->box_bytes(), Use::tree);
    if (!tree_.sorted_leaves)  // the padding of a layout on the leaf level
        arena.take<Aabb>(padding, Use::tree);
    arena.take<uint>(padding, Use::tree);
    tree_.device_objects = arena.take<ForestObject>(sizes.size(), Use::tree);

    leaf_order_.plan(arena, sizes, tree_.sorted_leaves ? Use::scratch : Use::tree, false);
    tree_.leaf_boxes = tree_.sorted_leaves ? Buffer<Aabb>{} : leaf_order_.boxes();
    tree_.ids = leaf_order_.ids();
    slots_ = arena.take<uint>(is_forest() && tree_.sorted_leaves ? sizes.size() : 0, Use::scratch);
    tree_.cells = plan_gather(
        arena, {tree_.nodes, tree_.layout.first_slot(primitives, implicit_leaf_level(primitives)),
                slots_});
    plan_hierarchy(arena);
}

void ImplicitBuilder::prepare(const cl::CommandQueue& queue)
{
    tree_.device_objects.upload(queue, tree_.objects);
    if (slots_.size() > 0) {
        std::vector<uint> slots;
        for (const ForestObject& object : tree_.objects)
            slots.push_back(
                object.nodes - object.first +
                tree_.layout.first_slot(object.leaves, implicit_leaf_level(object.leaves)));
        slots_.upload(queue, slots);
    }
    if (tree_.sorted_leaves)  // padding that a traversal may read
        tree_.nodes.upload(queue, stored_empty_boxes(*tree_.format, tree_.slot_count));
}

}  // namespace bvhbench
