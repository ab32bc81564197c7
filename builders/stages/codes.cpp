// SPDX-License-Identifier: MIT
#include "builders/stages/codes.h"

#include <string>

namespace bvhbench {
namespace {

/// How far the bounds of two neighbouring objects are from each other: 0 if there is one for all.
uint apart(const Buffer<Bounds>& bounds) { return bounds.size() > 1 ? 1 : 0; }

}  // namespace

CodesStage::CodesStage(Programs& programs, const OrderEntry& order, KernelForm form)
    : words_(code_words(order.code_bits))
    , group_size_(programs.device().tuned(codes_group_size))
    , form_(chosen_form(programs.device(), form))
    , chunks_(chunk_count(programs.device()))
{
    const bool by_groups = form_ == KernelForm::groups;
    const std::string define = "ORDER_" + std::string(order.kernel);
    const auto kernel = [&](const char* suffix) {
        const std::string name = order.kernel + std::string(suffix);
        return by_groups ? programs.kernel("builders/stages/codes.cl", name.c_str())
                         : programs.kernel("builders/stages/codes_chunks.cl", name.c_str(),
                                           {{define, 1}});
    };
    kernel_ = kernel("");
    objects_kernel_ = kernel("_objects");
    runs_kernel_ = kernel("_runs");
}

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
                  dropped, object_shift, apart(bounds));
    launch(objects_kernel_, boxes, codes, queue);
}

void CodesStage::enqueue(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds,
                         const ObjectRuns& runs, const Buffer<uint>& codes, uint dropped,
                         uint object_shift, Queue& queue)
{
    queue.begin("codes");
    set_arguments(runs_kernel_, boxes, bounds, runs.runs(), codes, dropped, object_shift,
                  apart(bounds));
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
    const bool by_groups = form_ == KernelForm::groups;
    const uint groups = divided_up(static_cast<uint>(boxes.size()), group_size_);
    queue.launch(kernel, by_groups ? std::size_t{groups} * group_size_ : chunks_,
                 by_groups ? group_size_ : 1,
                 static_cast<std::int64_t>(boxes.bytes() + codes.bytes()));
}

}  // namespace bvhbench
