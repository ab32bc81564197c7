// SPDX-License-Identifier: MIT
#include "builders/stages/medians/medians.h"

#include <cassert>

#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr std::size_t block_bytes =
    38 << 10;  // local memory of a group for 2^median_block_height leaves

}  // namespace

MedianShape median_shape(const Device& device, KernelForm form)
{
    MedianShape shape{.form = form};
    if (chosen_form(device, form) == KernelForm::groups)
        shape.group_size = device.tuned(medians_group_size);
    return shape;
}

BlockMedians::BlockMedians(Programs& programs, MedianShape shape) : shape_(shape)
{
    shape_.form = chosen_form(programs.device(), shape.form, block_bytes, shape.group_size);
    if (shape_.form == KernelForm::groups) {
        assert(shape.group_size >= 32 && shape.group_size <= 1u << shape.block_height);
        assert(shape.block_height <= 10);  // a place in a list has ten bits
        kernel_ = programs.kernel(
            "builders/stages/medians/medians_groups.cl", "order_blocks",
            {{"GROUP_HEIGHT", floor_log2(shape.group_size)}, {"BLOCK_HEIGHT", shape.block_height}},
            Optimise::on_gpus);
    } else {
        kernel_ = programs.kernel("builders/stages/medians/medians_chunks.cl", "halve_blocks");
    }
}

void BlockMedians::plan(Arena& arena, std::size_t size)
{
    const std::size_t leaves = shape_.form == KernelForm::chunks ? size : 0;
    leaves_.even = arena.take<Leaf>(leaves, Use::scratch);
    leaves_.odd = arena.take<Leaf>(leaves, Use::scratch);
}

void BlockMedians::enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids, Queue& queue)
{
    const auto count = static_cast<uint>(ids.size());
    if (count < 2)
        return;
    const std::size_t blocks = divided_up(count, 1u << shape_.block_height);
    const auto moved_bytes = static_cast<std::int64_t>(boxes.bytes() + 2 * ids.bytes());
    if (shape_.form == KernelForm::chunks) {
        set_arguments(kernel_, boxes, ids, leaves_.even, leaves_.odd, count, shape_.block_height);
        queue.launch(kernel_, blocks, 1, moved_bytes);
    } else {
        set_arguments(kernel_, boxes, ids, count);
        queue.launch(kernel_, blocks * shape_.group_size, shape_.group_size, moved_bytes);
    }
}

void NumberAll::enqueue(const Buffer<uint>& numbers, Queue& queue)
{
    constexpr uint group_size = 256;
    const auto count = static_cast<uint>(numbers.size());
    if (count == 0)
        return;
    set_arguments(kernel_, numbers, count);
    queue.launch(kernel_, std::size_t{divided_up(count, group_size)} * group_size, group_size,
                 static_cast<std::int64_t>(numbers.bytes()));
}

}  // namespace bvhbench
