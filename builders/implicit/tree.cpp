// SPDX-License-Identifier: MIT
#include "builders/implicit/tree.h"

namespace bvhbench {

std::size_t ImplicitTree::node_count() const
{
    const uint leaf_level = implicit_leaf_level(leaves);
    return std::size_t{layout.first_slot(leaves, leaf_level)} +
           layout.stored_on(leaves, leaf_level);
}

HostTree ImplicitTree::spelled_out() const
{
    const std::vector<Aabb> boxes = nodes.download(queue->cl());
    const std::vector<uint> primitives = ids.download(queue->cl());
    const std::vector<Aabb> mesh_order =
        sorted_leaves ? std::vector<Aabb>{} : leaf_boxes.download(queue->cl());

    // Breadth-first without padding: the used nodes of a level follow those of the level above.
    HostTree tree;
    const uint leaf_level = implicit_leaf_level(leaves);
    std::size_t below = 0;  // where the next level starts in tree.nodes
    for (uint level = 0; level <= leaf_level; ++level) {
        const uint used = implicit_used_on(leaves, level);
        below += used;
        for (uint p = 0; p < used; ++p) {
            HostTree::Node& node = tree.nodes.emplace_back();
            if (level == leaf_level) {
                node.primitive = static_cast<int>(primitives[p]);
                node.box = sorted_leaves ? boxes[layout.first_slot(leaves, level) + p]
                                         : mesh_order.at(primitives[p]);
                continue;
            }
            node.box = boxes[layout.first_slot(leaves, level) + p];
            const std::size_t child = below + std::size_t{2} * p;
            node.child[0] = static_cast<int>(child);
            if (2 * p + 1 < implicit_used_on(leaves, level + 1))
                node.child[1] = static_cast<int>(child + 1);
        }
    }
    return tree;
}

}  // namespace bvhbench
