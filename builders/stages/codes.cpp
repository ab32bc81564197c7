// SPDX-License-Identifier: MIT
#include "builders/stages/codes.h"

#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr uint group_size = 256;

}  // namespace

CodesStage::CodesStage(Programs& programs, const OrderEntry& order)
    : kernel_(programs.kernel("builders/stages/codes.cl", order.kernel))
{}

void CodesStage::enqueue(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds,
                         const Buffer<uint>& codes, Queue& queue)
{
    queue.begin("codes");
    const auto count = static_cast<uint>(boxes.size());
    if (count == 0)
        return;
    set_arguments(kernel_, boxes, bounds, codes, count);
    queue.launch(kernel_, std::size_t{divided_up(count, group_size)} * group_size, group_size,
                 static_cast<std::int64_t>(boxes.bytes() + codes.bytes()));
}

}  // namespace bvhbench
