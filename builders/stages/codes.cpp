// SPDX-License-Identifier: MIT
#include "builders/stages/codes.h"

#include "builders/stages/sort/waiting_sort.h"

namespace bvhbench {
namespace {

/// As many as run at a time. More groups would cost more: each fills a table (code_by_table.clh) and may add its counts of digits to
/// those of all groups.
constexpr uint items_per_unit = 1536;
constexpr uint counting_group_size = 512;

/// Returns the work-items of a launch for `count` boxes.
std::size_t items(const Device& device, uint count, uint group_size)
{
    const std::size_t units = device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    const std::size_t most = units * divided_up(items_per_unit, group_size);
    return std::min(std::size_t{divided_up(count, group_size)}, most) * group_size;
}

/// Returns the distance between the bounds of consecutive objects, in elements: 0 if all objects share one.
uint apart(const Buffer<Bounds>& bounds) { return bounds.size() > 1 ? 1 : 0; }

}  // namespace

CodesStage::CodesStage(Programs& programs, const OrderEntry& order, KernelForm form,
                       std::size_t objects)
    : programs_(programs)
    , order_(order)
    , is_forest_(objects > 1)
    , words_(code_words(order.code_bits))
    , kept_(kept_code_bits(order.code_bits, objects))
    , dropped_(order.code_bits - kept_)
    , group_size_(programs.device().tuned(codes_group_size))
    , form_(chosen_form(programs.device(), form))
    , chunks_(chunk_count(programs.device()))
{
    const char* path = form_ == KernelForm::groups ? "builders/stages/codes.cl"
                                                   : "builders/stages/codes_chunks.cl";
    kernel_ = programs.kernel(path, "codes_of_all", defines());
    runs_kernel_ = programs.kernel(path, "codes_of_runs", defines());
}

std::vector<Define> CodesStage::defines() const
{
    return {{"AXIS_BITS", order_.code_bits / 3},
            {"HILBERT", order_.is_hilbert ? 1u : 0u},
            {"STRETCHED", order_.is_stretched ? 1u : 0u},
            {"SEVERAL_OBJECTS", is_forest_ ? 1u : 0u}};
}

void CodesStage::plan_counting()
{
    std::vector<Define> all = defines();
    all.insert(all.end(), {{"DIGIT_BITS", tile_digit_bits}, {"MOST_PASSES", most_tile_passes}});
    counted_kernel_ = programs_.kernel("builders/stages/codes_counted.cl", "codes_counted", all);
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
    queue.launch(kernel_, by_groups ? items(programs_.device(), count, group_size_) : chunks_,
                 by_groups ? group_size_ : 1,
                 static_cast<std::int64_t>(boxes.bytes() + codes.bytes()));
}

void CodesStage::enqueue_counted(const Buffer<Aabb>& boxes, const Buffer<Bounds>& bounds,
                                 const Buffer<uint>& owners, const Buffer<uint>& codes,
                                 const Buffer<uint>& counters, uint bits, Queue& queue)
{
    queue.begin("codes");
    const auto count = static_cast<uint>(boxes.size());
    if (count == 0)
        return;
    set_arguments(counted_kernel_, boxes, bounds, owners, codes, count, dropped_, kept_,
                  apart(bounds), counters, bits);
    queue.launch(counted_kernel_, items(programs_.device(), count, counting_group_size),
                 counting_group_size, static_cast<std::int64_t>(boxes.bytes() + codes.bytes()));
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
