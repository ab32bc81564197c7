// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

#include "builders/stages/medians/cells.h"
#include "builders/stages/medians/medians.h"
#include "geometry/bits.h"
#include "geometry/grid.h"
#include "geometry/split.h"

namespace bvhbench {
namespace {

Aabb box_of_centres(std::span<const Aabb> boxes, std::span<const uint> ids)
{
    Aabb centres = empty_box();
    for (const uint id : ids)
        centres = grown_to(centres, box_centre(boxes[id]));
    return centres;
}

/// Moves the `left` leaves that are first along an axis, equals by id, before all others.
void halve(std::span<const Aabb> boxes, std::span<uint> ids, std::size_t left, uint axis)
{
    const auto place = [&](uint id) {
        return std::pair(split_key(box_centre(boxes[id]), axis), id);
    };
    std::nth_element(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(left), ids.end(),
                     [&](uint a, uint b) { return place(a) < place(b); });
}

float cost_of(std::span<const Aabb> boxes, std::span<const uint> ids, float scale)
{
    const Aabb box = box_of_centres(boxes, ids);
    return cost_of_half(box.max_x - box.min_x, box.max_y - box.min_y, box.max_z - box.min_z, scale,
                        static_cast<uint>(ids.size()));
}

void halve_by_cost(std::span<const Aabb> boxes, std::span<uint> ids, uint height, float scale)
{
    if (height == 0 || ids.empty())
        return;
    const std::size_t left = left_count(static_cast<uint>(ids.size()), height);
    if (left < ids.size()) {
        float costs[3];
        for (uint axis = 0; axis < 3; ++axis) {
            halve(boxes, ids, left, axis);
            costs[axis] =
                cost_of(boxes, ids.first(left), scale) + cost_of(boxes, ids.subspan(left), scale);
        }
        halve(boxes, ids, left, cheapest_axis(costs[0], costs[1], costs[2]));
    }
    halve_by_cost(boxes, ids.first(left), height - 1, scale);
    halve_by_cost(boxes, ids.subspan(left), height - 1, scale);
}

void halve_by_cell(std::span<const Aabb> boxes, std::span<uint> ids, uint level, uint height,
                   uint block_height, const Aabb& cell)
{
    if (height <= block_height || ids.empty())
        return;
    const std::size_t left = left_count(static_cast<uint>(ids.size()), height);
    if (left == ids.size())
        return halve_by_cell(boxes, ids, level + 1, height - 1, block_height, cell);
    const uint slabs = slab_count(level, height);
    CellCut cut = cut_of_cell(cell, slabs);
    halve(boxes, ids, left, cut.axis);
    for (const uint id : ids.first(left))
        cut.slab =
            std::max(cut.slab, slab_of(cut, coordinate(box_centre(boxes[id]), cut.axis), slabs));
    halve_by_cell(boxes, ids.first(left), level + 1, height - 1, block_height,
                  left_cell(cell, cut, slabs));
    halve_by_cell(boxes, ids.subspan(left), level + 1, height - 1, block_height,
                  right_cell(cell, cut, slabs));
}

}  // namespace

void host_block_medians(std::span<const Aabb> boxes, std::span<uint> ids, uint block_height)
{
    const std::size_t block = std::size_t{1} << block_height;
    for (std::size_t first = 0; first < ids.size(); first += block) {
        const std::span<uint> own = ids.subspan(first, std::min(block, ids.size() - first));
        const float scale = scale_to_one(longest_side(box_of_centres(boxes, own), 1.0f));
        halve_by_cost(boxes, own, block_height, scale);
    }
}

void host_cell_medians(std::span<const Aabb> boxes, std::span<uint> ids, uint block_height)
{
    if (!ids.empty())
        halve_by_cell(boxes, ids, 0, ceil_log2(static_cast<uint>(ids.size())), block_height,
                      box_of_centres(boxes, ids));
}

}  // namespace bvhbench
