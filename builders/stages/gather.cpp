// SPDX-License-Identifier: MIT
#include "builders/stages/gather.h"

#include <algorithm>
#include <cassert>

#include "geometry/bits.h"
#include "geometry/error.h"

namespace bvhbench {
namespace {

constexpr auto path = "builders/stages/gather.cl";
constexpr uint cells_group_size = 64;

bool has_doubles(const Device& device)
{
    return device.cl.getInfo<CL_DEVICE_EXTENSIONS>().find("cl_khr_fp64") != std::string::npos;
}

}  // namespace

GatherStage::GatherStage(Programs& programs, KernelForm form, uint group_size,
                         const BoxFormat& format)
    : form_(chosen_form(programs.device(), form))
    , group_size_(group_size != 0 || form_ == KernelForm::chunks
                      ? std::max(1u, group_size)
                      : programs.device().tuned(gather_group_size))
    , chunks_(chunk_count(programs.device()))
    , format_(format)
{
    if (format.number != BOX_F32 && !has_doubles(programs.device()))
        throw Unavailable("boxes of " + std::string(format.name) + " are made by doubles, which " +
                          programs.device().name() + " has not");
    const bool groups = form_ == KernelForm::groups;
    const auto kernel = [&](const char* of_groups, const char* of_chunks) {
        const char* name = groups ? of_groups : of_chunks;
        return programs.kernel(path, name,
                               {{"BOX_FORMAT", format.number}, {"GROUP_SIZE", group_size_}});
    };
    kernel_ = kernel("gather_groups", "gather_chunks");
    objects_kernel_ = kernel("gather_objects_groups", "gather_objects_chunks");
    runs_kernel_ = kernel("gather_runs_groups", "gather_runs_chunks");
    if (format.has_cells())
        cells_kernel_ = programs.kernel(
            "builders/stages/medians/scene_cells.cl", "find_cells",
            {{"GROUP_SIZE", groups ? cells_group_size : 1u}, {"CELLS_OF", format.number}});
}

void GatherStage::plan(Arena& arena, const Buffer<Bounds>& bounds)
{
    bounds_ = bounds;
    cells_ = arena.take<SceneCells>(format_.number != BOX_F32 ? 1 : 0, Use::tree);
}

void GatherStage::find_cells(Queue& queue)
{
    const std::size_t group = form_ == KernelForm::groups ? cells_group_size : 1;
    set_arguments(cells_kernel_, bounds_, static_cast<uint>(bounds_.size()), cells_);
    queue.launch(cells_kernel_, group, group,
                 static_cast<std::int64_t>(bounds_.bytes() + cells_.bytes()));
}

/// All arguments, those of the format behind the others.
template <class... Arguments>
void GatherStage::bind(cl::Kernel& kernel, const Arguments&... arguments) const
{
    if (format_.number == BOX_F32)
        set_arguments(kernel, arguments...);
    else
        set_arguments(kernel, arguments..., cells_);
}

void GatherStage::enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids,
                          const Buffer<std::byte>& sorted, uint first, Queue& queue)
{
    assert((first + ids.size()) * format_.box_bytes() <= sorted.bytes());
    bind(kernel_, boxes, ids, sorted, first, static_cast<uint>(ids.size()));
    launch(kernel_, ids.size(), 0, queue);
}

void GatherStage::enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids,
                          const Buffer<uint>& owners, const Buffer<uint>& slots,
                          const Buffer<std::byte>& sorted, Queue& queue)
{
    bind(objects_kernel_, boxes, ids, owners, slots, sorted, static_cast<uint>(ids.size()));
    launch(objects_kernel_, ids.size(), owners.bytes(), queue);
}

void GatherStage::enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids,
                          const ObjectRuns& runs, const Buffer<uint>& slots,
                          const Buffer<std::byte>& sorted, Queue& queue)
{
    assert(!format_.has_cells());
    queue.begin("gather");
    if (runs.count() == 0)
        return;
    bind(runs_kernel_, boxes, ids, runs.runs(), slots, sorted);
    queue.launch(runs_kernel_, runs.count() * runs.group(), runs.group(),
                 moved_bytes(runs.triangles()));
}

/// A box read, through its triangle's number, and one written.
std::int64_t GatherStage::moved_bytes(std::size_t count) const
{
    return static_cast<std::int64_t>(count * (sizeof(uint) + sizeof(Aabb) + format_.box_bytes()));
}

void GatherStage::launch(cl::Kernel& kernel, std::size_t count, std::size_t more_bytes,
                         Queue& queue)
{
    queue.begin("gather");
    if (count == 0)
        return;
    if (format_.has_cells())
        find_cells(queue);
    const std::int64_t moved = moved_bytes(count) + static_cast<std::int64_t>(more_bytes);
    if (form_ == KernelForm::groups)
        queue.launch(kernel,
                     std::size_t{divided_up(static_cast<uint>(count), group_size_)} * group_size_,
                     group_size_, moved);
    else
        queue.launch(kernel, std::min(count, chunks_), 1, moved);
}

}  // namespace bvhbench
