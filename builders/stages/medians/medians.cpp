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
    assert(shape.block_height <=
           10);  // a place in a list of groups has ten bits, and chunks have lists of that size
    shape_.form = chosen_form(programs.device(), shape.form, block_bytes, shape.group_size);
    if (shape_.form == KernelForm::groups) {
        assert(shape.group_size >= 32 && shape.group_size <= 1u << shape.block_height);
        kernel_ = programs.kernel(
            "builders/stages/medians/medians_groups.cl", "order_blocks",
            {{"GROUP_HEIGHT", floor_log2(shape.group_size)}, {"BLOCK_HEIGHT", shape.block_height}},
            Optimise::on_gpus);
    } else {
        kernel_ = programs.kernel("builders/stages/medians/medians_chunks.cl", "halve_blocks",
                                  {{"BLOCK_HEIGHT", shape.block_height}});
    }
}

void BlockMedians::enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids, Queue& queue)
{
    const auto count = static_cast<uint>(ids.size());
    if (count < 2)
        return;
    const std::size_t blocks = divided_up(count, 1u << shape_.block_height);
    const auto moved_bytes = static_cast<std::int64_t>(boxes.bytes() + 2 * ids.bytes());
    const std::size_t group_size = shape_.form == KernelForm::chunks ? 1 : shape_.group_size;
    set_arguments(kernel_, boxes, ids, count);
    queue.launch(kernel_, blocks * group_size, group_size, moved_bytes);
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
