// SPDX-License-Identifier: MIT
#include "cluster/top_boxes.h"

#include <bit>
#include <cassert>

#include "collide/device_lists.h"
#include "geometry/error.h"

namespace bvhbench {

void TopBoxes::reserve(const DeviceTree& tree)
{
    assert(tree.leaf_count() > 1 && std::has_single_bit(count_));
    if (static_cast<uint>(std::countr_zero(count_)) % tree.child_bits() != 0)
        throw BadUsage("no level of trees with " + std::to_string(1u << tree.child_bits()) +
                       " children a node has " + std::to_string(count_) + " nodes");
    const Define defines[] = {{"SORTED_LEAVES", tree.has_sorted_leaves() ? 1u : 0u},
                              {"BOX_FORMAT", tree.box_format().number},
                              {"TOP_BOXES", count_}};
    kernel_ = programs_.kernel(tree.access_header(), "cluster/top_boxes.cl", "top_boxes", defines);
    take_memory(arena_, programs_.device(),
                [&](Arena& arena) { boxes_ = arena.take<Aabb>(count_, Use::scratch); });
}

std::vector<Aabb> TopBoxes::read(const DeviceTree& tree, Queue& queue)
{
    queue.begin("top");
    set_arguments_from(kernel_, tree.bind(kernel_, 0), boxes_);
    queue.launch(kernel_, count_, 1, static_cast<std::int64_t>(2 * boxes_.bytes()));
    std::vector<Aabb> boxes(count_);
    queue.read(boxes_.cl(), boxes_.bytes(), boxes.data());
    return boxes;
}

}  // namespace bvhbench
