// SPDX-License-Identifier: MIT
#include "builders/stages/gather.h"

#include <algorithm>
#include <cassert>

#include "geometry/bits.h"
#include "geometry/error.h"

namespace bvhbench {
namespace {

constexpr auto gather_kernels = "builders/stages/gather.cl";
constexpr uint cells_group_size = 64;

bool has_doubles(const Device& device)
{
    return device.cl.getInfo<CL_DEVICE_EXTENSIONS>().find("cl_khr_fp64") != std::string::npos;
}

}  // namespace

GatherStage::GatherStage(Programs& programs, KernelForm form, uint group_size,
                         const BoxFormat& format)
    : programs_(programs)
    , form_(chosen_form(programs.device(), form))
    , group_size_(group_size != 0 || form_ == KernelForm::chunks
                      ? std::max(1u, group_size)
                      : programs.device().tuned(gather_group_size))
    , chunks_(chunk_count(programs.device()))
    , format_(format)
{
    if (format.number != BOX_F32 && !has_doubles(programs.device()))
        throw Unavailable("boxes of " + std::string(format.name) + " are made by doubles, which " +
                          programs.device().name() + " has not");
}

void GatherStage::plan(Arena& arena, const GatherPlace& place, const Buffer<Bounds>& bounds)
{
    place_ = place;
    bounds_ = bounds;
    cells_ = arena.take<SceneCells>(format_.number != BOX_F32 ? 1 : 0, Use::tree);
    const bool groups = form_ == KernelForm::groups;
    const auto kernel = [&](const char* of_groups, const char* of_chunks) {
        return programs_.kernel(gather_kernels, groups ? of_groups : of_chunks,
                                {{"BOX_FORMAT", format_.number},
                                 {"GROUP_SIZE", group_size_},
                                 {"SEVERAL_OBJECTS", place.slots.size() > 0 ? 1u : 0u}});
    };
    kernel_ = kernel("gather_groups", "gather_chunks");
    runs_kernel_ = kernel("gather_runs_groups", "gather_runs_chunks");
    if (format_.has_cells())
        cells_kernel_ = programs_.kernel(
            "builders/stages/scene_cells.cl", "find_cells",
            {{"GROUP_SIZE", groups ? cells_group_size : 1u}, {"CELLS_OF", format_.number}});
}

void GatherStage::find_cells(Queue& queue)
{
    const std::size_t group = form_ == KernelForm::groups ? cells_group_size : 1;
    set_arguments(cells_kernel_, bounds_, static_cast<uint>(bounds_.size()), cells_);
    queue.launch(cells_kernel_, group, group,
                 static_cast<std::int64_t>(bounds_.bytes() + cells_.bytes()));
}

/// Sets all arguments, that of the format last.
template <class... Arguments>
void GatherStage::bind(cl::Kernel& kernel, const Arguments&... arguments) const
{
    if (format_.number == BOX_F32)
        set_arguments(kernel, arguments...);
    else
        set_arguments(kernel, arguments..., cells_);
}

void GatherStage::enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids,
                          const Buffer<uint>& owners, Queue& queue)
{
    queue.begin("gather");
    const auto count = static_cast<uint>(ids.size());
    if (count == 0)
        return;
    if (format_.has_cells())
        find_cells(queue);
    const bool by_slots = place_.slots.size() > 0;
    assert(by_slots || (place_.first + ids.size()) * format_.box_bytes() <= place_.boxes.bytes());
    bind(kernel_, boxes, ids, place_.boxes, owners, place_.slots, place_.first, count);
    const std::int64_t moved =
        moved_bytes(count) + static_cast<std::int64_t>(by_slots ? owners.bytes() : 0);
    if (form_ == KernelForm::groups)
        queue.launch(kernel_, std::size_t{divided_up(count, group_size_)} * group_size_,
                     group_size_, moved);
    else
        queue.launch(kernel_, std::min<std::size_t>(count, chunks_), 1, moved);
}

void GatherStage::enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids,
                          const ObjectRuns& runs, Queue& queue)
{
    assert(!format_.has_cells());
    queue.begin("gather");
    if (runs.count() == 0)
        return;
    bind(runs_kernel_, boxes, ids, place_.boxes, runs.runs(), place_.slots);
    queue.launch(runs_kernel_, runs.count() * runs.group(), runs.group(),
                 moved_bytes(runs.triangles()));
}

/// Returns the bytes moved: per triangle, its id and its box read and one box written.
std::int64_t GatherStage::moved_bytes(std::size_t count) const
{
    return static_cast<std::int64_t>(count * (sizeof(uint) + sizeof(Aabb) + format_.box_bytes()));
}

}  // namespace bvhbench
