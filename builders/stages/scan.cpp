// SPDX-License-Identifier: MIT
#include "builders/stages/scan.h"

#include <algorithm>
#include <cassert>

#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr auto scan_kernels = "builders/stages/scan.cl";
constexpr uint group_size = 256;
constexpr uint values_per_item = 4;
constexpr uint tile = values_per_item * group_size;

}  // namespace

ScanStage::ScanStage(Programs& programs, KernelForm form)
    : form_(chosen_form(programs.device(), form)), chunks_(chunk_count(programs.device()))
{
    const bool groups = form_ == KernelForm::groups;
    const auto kernel = [&](const char* name) {
        return programs.kernel(scan_kernels, name,
                               {{"GROUP_SIZE", group_size}, {"VALUES_PER_ITEM", values_per_item}});
    };
    sum_ = kernel(groups ? "sum_groups" : "sum_chunks");
    scan_partials_ = kernel(groups ? "scan_partials_group" : "scan_partials_chunk");
    scan_ = kernel(groups ? "scan_groups" : "scan_chunks");
}

std::size_t ScanStage::partial_count(std::size_t size) const
{
    const auto count = static_cast<uint>(size);
    return form_ == KernelForm::groups ? divided_up(count, tile) : std::min(size, chunks_);
}

void ScanStage::plan(Arena& arena, std::size_t size)
{
    partials_ = arena.take<uint>(partial_count(size), Use::scratch);
}

void ScanStage::enqueue(const Buffer<uint>& values, Queue& queue)
{
    const auto count = static_cast<uint>(values.size());
    const auto partials = static_cast<uint>(partials_.size());
    assert(partials == partial_count(count));
    if (count == 0)
        return;
    const std::size_t group = form_ == KernelForm::groups ? group_size : 1;
    const auto moved = static_cast<std::int64_t>(values.bytes());
    queue.launch(set_arguments(sum_, values, partials_, count), partials * group, group, moved);
    queue.launch(set_arguments(scan_partials_, partials_, partials), group, group,
                 2 * static_cast<std::int64_t>(partials_.bytes()));
    queue.launch(set_arguments(scan_, values, partials_, count), partials * group, group,
                 2 * moved);
}

}  // namespace bvhbench
