// SPDX-License-Identifier: MIT
#include "builders/stages/gather.h"

#include <algorithm>
#include <cassert>

#include "geometry/bits.h"

namespace bvhbench {

GatherStage::GatherStage(Programs& programs, KernelForm form, uint group_size)
    : form_(chosen_form(programs.device(), form))
    , group_size_(group_size != 0 || form_ == KernelForm::chunks
                      ? std::max(1u, group_size)
                      : programs.device().tuned(gather_group_size))
    , chunks_(chunk_count(programs.device()))
{
    const bool groups = form_ == KernelForm::groups;
    const auto kernel = [&](const char* of_groups, const char* of_chunks) {
        return programs.kernel("builders/stages/gather.cl", groups ? of_groups : of_chunks,
                               {{"GROUP_SIZE", group_size_}});
    };
    kernel_ = kernel("gather_groups", "gather_chunks");
    objects_kernel_ = kernel("gather_objects_groups", "gather_objects_chunks");
    runs_kernel_ = kernel("gather_runs_groups", "gather_runs_chunks");
}

void GatherStage::enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids,
                          const Buffer<Aabb>& sorted, uint first, Queue& queue)
{
    assert(first + ids.size() <= sorted.size());
    set_arguments(kernel_, boxes, ids, sorted, first, static_cast<uint>(ids.size()));
    launch(kernel_, ids.size(), 0, queue);
}

void GatherStage::enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids,
                          const Buffer<uint>& owners, const Buffer<uint>& slots,
                          const Buffer<Aabb>& sorted, Queue& queue)
{
    set_arguments(objects_kernel_, boxes, ids, owners, slots, sorted,
                  static_cast<uint>(ids.size()));
    launch(objects_kernel_, ids.size(), owners.bytes(), queue);
}

void GatherStage::enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids,
                          const ObjectRuns& runs, const Buffer<uint>& slots,
                          const Buffer<Aabb>& sorted, Queue& queue)
{
    queue.begin("gather");
    if (runs.count() == 0)
        return;
    set_arguments(runs_kernel_, boxes, ids, runs.runs(), slots, sorted);
    queue.launch(runs_kernel_, runs.count() * runs.group(), runs.group(),
                 static_cast<std::int64_t>(runs.triangles() * (sizeof(uint) + 2 * sizeof(Aabb))));
}

void GatherStage::launch(cl::Kernel& kernel, std::size_t count, std::size_t more_bytes,
                         Queue& queue)
{
    queue.begin("gather");
    if (count == 0)
        return;
    const auto moved =
        static_cast<std::int64_t>(count * (sizeof(uint) + 2 * sizeof(Aabb)) + more_bytes);
    if (form_ == KernelForm::groups)
        queue.launch(kernel,
                     std::size_t{divided_up(static_cast<uint>(count), group_size_)} * group_size_,
                     group_size_, moved);
    else
        queue.launch(kernel, std::min(count, chunks_), 1, moved);
}

}  // namespace bvhbench
