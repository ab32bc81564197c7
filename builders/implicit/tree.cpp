// SPDX-License-Identifier: MIT
#include "builders/implicit/tree.h"

#include <span>

namespace bvhbench {

std::size_t ImplicitTree::slots(uint leaf_count) const
{
    const uint leaf_level = implicit_leaf_level(leaf_count);
    return std::size_t{layout.first_slot(leaf_count, leaf_level)} +
           (sorted_leaves ? layout.stored_on(leaf_count, leaf_level) : 0);
}

std::size_t ImplicitTree::node_count() const
{
    std::size_t count = 0;
    for (const ForestObject& object : objects) {
        const uint leaf_level = implicit_leaf_level(object.leaves);
        count += std::size_t{layout.first_slot(object.leaves, leaf_level)} +
                 layout.stored_on(object.leaves, leaf_level);
    }
    return count;
}

BoxRounding ImplicitTree::rounding() const
{
    return {format, format->has_cells() ? cells.download(queue->cl()).front() : SceneCells{}};
}

HostTree ImplicitTree::object_to_host_tree(uint object) const
{
    const ForestObject& own = objects.at(object);
    const uint own_leaves = own.leaves;
    const std::vector<std::byte> all_boxes = nodes.download(queue->cl());
    const std::vector<uint> all_primitives = ids.download(queue->cl());
    const BoxRounding own_rounding = rounding();
    const std::size_t box_bytes = format->box_bytes();
    const auto box_in = [&](std::size_t slot) {
        return own_rounding.read(
            std::span(all_boxes).subspan((own.nodes + slot) * box_bytes, box_bytes));
    };
    const std::span<const uint> primitives =
        std::span(all_primitives).subspan(own.first, own_leaves);
    const std::vector<Aabb> mesh_order =
        sorted_leaves ? std::vector<Aabb>{} : leaf_boxes.download(queue->cl());

    // Nodes are in breadth-first order without padding: the used nodes of a level follow those of the level above.
    HostTree tree;
    tree.rounding = own_rounding;
    const uint leaf_level = implicit_leaf_level(own_leaves);
    std::size_t count = 0;
    for (uint level = 0; level <= leaf_level; ++level)
        count += implicit_used_on(own_leaves, level);
    tree.nodes.reserve(count);
    std::size_t below = 0;  // start of the next level in tree.nodes
    for (uint level = 0; level <= leaf_level; ++level) {
        const uint used = implicit_used_on(own_leaves, level);
        below += used;
        for (uint p = 0; p < used; ++p) {
            HostTree::Node& node = tree.nodes.emplace_back();
            if (level == leaf_level) {
                node.primitive = static_cast<int>(primitives[p]);
                node.box = sorted_leaves ? box_in(layout.first_slot(own_leaves, level) + p)
                                         : mesh_order.at(primitives[p]);
                continue;
            }
            node.box = box_in(layout.first_slot(own_leaves, level) + p);
            const std::size_t child = below + std::size_t{2} * p;
            node.child[0] = static_cast<int>(child);
            if (2 * p + 1 < implicit_used_on(own_leaves, level + 1))
                node.child[1] = static_cast<int>(child + 1);
        }
    }
    return tree;
}

}  // namespace bvhbench
