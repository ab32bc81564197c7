// SPDX-License-Identifier: MIT
#include "builders/stages/codes.h"

#include <string>

#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr uint group_size = 256;

}  // namespace

CodesStage::CodesStage(Programs& programs, const OrderEntry& order)
    : kernel_(programs.kernel("builders/stages/codes.cl", order.kernel))
    , objects_kernel_(programs.kernel("builders/stages/codes.cl",
                                      (std::string(order.kernel) + "_objects").c_str()))
{}

void CodesStage::enqueue(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds,
                         const Buffer<uint>& codes, Queue& queue)
{
    set_arguments(kernel_, boxes, bounds, codes, static_cast<uint>(boxes.size()));
    launch(kernel_, boxes, codes, queue);
}

void CodesStage::enqueue(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds,
                         const Buffer<uint>& owners, const Buffer<uint>& codes, uint dropped,
                         uint object_shift, Queue& queue)
{
    set_arguments(objects_kernel_, boxes, bounds, owners, codes, static_cast<uint>(boxes.size()),
                  dropped, object_shift);
    launch(objects_kernel_, boxes, codes, queue);
}

void CodesStage::launch(cl::Kernel& kernel, const Buffer<Aabb>& boxes, const Buffer<uint>& codes,
                        Queue& queue)
{
    queue.begin("codes");
    if (boxes.size() == 0)
        return;
    const uint groups = divided_up(static_cast<uint>(boxes.size()), group_size);
    queue.launch(kernel, std::size_t{groups} * group_size, group_size,
                 static_cast<std::int64_t>(boxes.bytes() + codes.bytes()));
}

}  // namespace bvhbench
