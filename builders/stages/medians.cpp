// SPDX-License-Identifier: MIT
#include "builders/stages/medians.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "geometry/bits.h"
#include "geometry/split.h"

namespace bvhbench {

BlockMedians::BlockMedians(Programs& programs, MedianShape shape) : shape_(shape)
{
    shape_.form = chosen_form(programs.device(), shape.form);
    if (shape_.form == KernelForm::groups) {
        assert(shape.group_size <= 1u << shape.block_height);
        kernel_ = programs.kernel(
            "builders/stages/medians_groups.cl", "order_blocks",
            {{"GROUP_HEIGHT", floor_log2(shape.group_size)}, {"BLOCK_HEIGHT", shape.block_height}});
    } else {
        kernel_ = programs.kernel("builders/stages/medians_chunks.cl", "halve_runs");
    }
}

void BlockMedians::plan(Arena& arena, std::size_t size)
{
    keys_ = arena.take<ulong>(shape_.form == KernelForm::chunks ? size : 0, Use::scratch);
}

void BlockMedians::enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids, Queue& queue)
{
    const auto count = static_cast<uint>(ids.size());
    if (count < 2)
        return;
    if (shape_.form == KernelForm::chunks)
        return halve_runs(boxes, ids, shape_.block_height, 1, queue);
    const std::size_t groups = divided_up(count, 1u << shape_.block_height);
    set_arguments(kernel_, boxes, ids, count);
    queue.launch(kernel_, groups * shape_.group_size, shape_.group_size,
                 static_cast<std::int64_t>(boxes.bytes() + 2 * ids.bytes()));
}

void BlockMedians::halve_runs(const Buffer<Aabb>& boxes, const Buffer<uint>& ids, uint top,
                              uint bottom, Queue& queue)
{
    assert(shape_.form == KernelForm::chunks && ids.size() == keys_.size());
    const auto count = static_cast<uint>(ids.size());
    set_arguments(kernel_, boxes, ids, keys_, count, top, bottom);
    queue.launch(kernel_, divided_up(count, 1u << top), 1,
                 static_cast<std::int64_t>(boxes.bytes() + 2 * ids.bytes()));
}

void host_medians(std::span<const Aabb> boxes, std::span<uint> ids, uint height)
{
    const std::size_t block = std::size_t{1} << height;
    if (height == 0)
        return;
    for (std::size_t first = 0; first < ids.size(); first += block) {
        const std::span<uint> own = ids.subspan(first, std::min(block, ids.size() - first));
        const std::size_t left = std::min(own.size(), block / 2);
        Aabb centres = empty_box();
        for (const uint id : own)
            centres = grown_to(centres, box_centre(boxes[id]));
        const auto place = [&, axis = widest_axis(centres)](uint id) {
            return std::pair(split_key(box_centre(boxes[id]), axis), id);
        };
        std::nth_element(own.begin(), own.begin() + static_cast<std::ptrdiff_t>(left), own.end(),
                         [&](uint a, uint b) { return place(a) < place(b); });
    }
    host_medians(boxes, ids, height - 1);
}

}  // namespace bvhbench
