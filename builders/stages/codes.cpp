// SPDX-License-Identifier: MIT
#include "builders/stages/codes.h"

namespace bvhbench {
namespace {

/// Returns the distance between the bounds of consecutive objects, in elements: 0 if all objects share one.
uint apart(const Buffer<Bounds>& bounds) { return bounds.size() > 1 ? 1 : 0; }

}  // namespace

CodesStage::CodesStage(Programs& programs, const OrderEntry& order, KernelForm form,
                       std::size_t objects)
    : words_(code_words(order.code_bits))
    , kept_(kept_code_bits(order.code_bits, objects))
    , dropped_(order.code_bits - kept_)
    , group_size_(programs.device().tuned(codes_group_size))
    , form_(chosen_form(programs.device(), form))
    , chunks_(chunk_count(programs.device()))
{
    const auto kernel = [&](const char* name) {
        return programs.kernel(form_ == KernelForm::groups ? "builders/stages/codes.cl"
                                                           : "builders/stages/codes_chunks.cl",
                               name,
                               {{"AXIS_BITS", order.code_bits / 3},
                                {"HILBERT", order.is_hilbert ? 1u : 0u},
                                {"STRETCHED", order.is_stretched ? 1u : 0u},
                                {"SEVERAL_OBJECTS", objects > 1 ? 1u : 0u}});
    };
    kernel_ = kernel("codes_of_all");
    runs_kernel_ = kernel("codes_of_runs");
}

void CodesStage::enqueue(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds,
                         const Buffer<uint>& owners, const Buffer<uint>& codes, Queue& queue)
{
    queue.begin("codes");
    const auto count = static_cast<uint>(boxes.size());
    if (count == 0)
        return;
    set_arguments(kernel_, boxes, bounds, owners, codes, count, dropped_, kept_, apart(bounds));
    const bool by_groups = form_ == KernelForm::groups;
    queue.launch(
        kernel_, by_groups ? std::size_t{divided_up(count, group_size_)} * group_size_ : chunks_,
        by_groups ? group_size_ : 1, static_cast<std::int64_t>(boxes.bytes() + codes.bytes()));
}

void CodesStage::enqueue(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds,
                         const ObjectRuns& runs, const Buffer<uint>& codes, Queue& queue)
{
    queue.begin("codes");
    set_arguments(runs_kernel_, boxes, bounds, runs.runs(), codes, dropped_, kept_, apart(bounds));
    queue.launch(runs_kernel_, runs.lined_up_count() * runs.group(), runs.group(),
                 static_cast<std::int64_t>(runs.lined_up_triangles() *
                                           (sizeof(Aabb) + words_ * sizeof(uint))));
}

}  // namespace bvhbench
