// SPDX-License-Identifier: MIT
#include "builders/stages/gather.h"

#include <algorithm>
#include <cassert>

#include "geometry/bits.h"

namespace bvhbench {

GatherStage::GatherStage(Programs& programs, KernelForm form, uint group_size)
    : form_(chosen_form(programs.device(), form))
    , group_size_(group_size)
    , chunks_(chunk_count(programs.device()))
    , kernel_(programs.kernel("builders/stages/gather.cl",
                              form_ == KernelForm::groups ? "gather_groups" : "gather_chunks",
                              {{"GROUP_SIZE", group_size}}))
{}

void GatherStage::enqueue(const Buffer<Aabb>& boxes, const Buffer<uint>& ids,
                          const Buffer<Aabb>& sorted, uint first, Queue& queue)
{
    queue.begin("gather");
    const auto count = static_cast<uint>(ids.size());
    assert(first + ids.size() <= sorted.size());
    if (count == 0)
        return;
    const auto moved = static_cast<std::int64_t>(ids.bytes() + 2 * ids.size() * sizeof(Aabb));
    set_arguments(kernel_, boxes, ids, sorted, first, count);
    if (form_ == KernelForm::groups)
        queue.launch(kernel_, std::size_t{divided_up(count, group_size_)} * group_size_,
                     group_size_, moved);
    else
        queue.launch(kernel_, std::min(ids.size(), chunks_), 1, moved);
}

}  // namespace bvhbench
