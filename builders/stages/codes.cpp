// SPDX-License-Identifier: MIT
#include "builders/stages/codes.h"

#include <string>

#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr auto path = "builders/stages/codes.cl";

}  // namespace

CodesStage::CodesStage(Programs& programs, const OrderEntry& order)
    : words_(code_words(order.code_bits))
    , group_size_(programs.device().tuned(codes_group_size))
    , kernel_(programs.kernel(path, order.kernel))
    , objects_kernel_(programs.kernel(path, (std::string(order.kernel) + "_objects").c_str()))
    , runs_kernel_(programs.kernel(path, (std::string(order.kernel) + "_runs").c_str()))
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

void CodesStage::enqueue(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds,
                         const ObjectRuns& runs, const Buffer<uint>& codes, uint dropped,
                         uint object_shift, Queue& queue)
{
    queue.begin("codes");
    set_arguments(runs_kernel_, boxes, bounds, runs.runs(), codes, dropped, object_shift);
    queue.launch(runs_kernel_, runs.lined_up_count() * runs.group(), runs.group(),
                 static_cast<std::int64_t>(runs.lined_up_triangles() *
                                           (sizeof(Aabb) + words_ * sizeof(uint))));
}

void CodesStage::launch(cl::Kernel& kernel, const Buffer<Aabb>& boxes, const Buffer<uint>& codes,
                        Queue& queue)
{
    queue.begin("codes");
    if (boxes.size() == 0)
        return;
    const uint groups = divided_up(static_cast<uint>(boxes.size()), group_size_);
    queue.launch(kernel, std::size_t{groups} * group_size_, group_size_,
                 static_cast<std::int64_t>(boxes.bytes() + codes.bytes()));
}

}  // namespace bvhbench
