// SPDX-License-Identifier: MIT
#include "cluster/top_boxes.h"

#include <cassert>

#include "collide/device_lists.h"

namespace bvhbench {

void TopBoxes::reserve(const DeviceTree& tree)
{
    assert(tree.leaf_count() > 1);
    const Define defines[] = {{"SORTED_LEAVES", tree.has_sorted_leaves() ? 1u : 0u},
                              {"BOX_FORMAT", tree.box_format().number},
                              {"TOP_BOXES", top_boxes}};
    kernel_ = programs_.kernel(tree.access_header(), "cluster/top_boxes.cl", "top_boxes", defines);
    take_memory(arena_, programs_.device(),
                [&](Arena& arena) { boxes_ = arena.take<Aabb>(top_boxes, Use::scratch); });
}

std::vector<Aabb> TopBoxes::read(const DeviceTree& tree, Queue& queue)
{
    queue.begin("top");
    set_arguments_from(kernel_, tree.bind(kernel_, 0), boxes_);
    queue.launch(kernel_, top_boxes, 1, static_cast<std::int64_t>(2 * boxes_.bytes()));
    std::vector<Aabb> boxes(top_boxes);
    queue.read(boxes_.cl(), boxes_.bytes(), boxes.data());
    return boxes;
}

}  // namespace bvhbench
