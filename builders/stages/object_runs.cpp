// SPDX-License-Identifier: MIT
#include "builders/stages/object_runs.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "geometry/bits.h"

namespace bvhbench {

ObjectRuns::ObjectRuns(const Device& device, KernelForm form, uint group_size)
    : form_(chosen_form(device, form)), group_size_(group_size), chunks_(chunk_count(device))
{}

void ObjectRuns::plan(Arena& arena, std::span<const uint> sizes)
{
    sizes_.assign(sizes.begin(), sizes.end());
    const auto total = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
    std::size_t most = std::min(total, chunks_ + sizes.size());
    if (form_ == KernelForm::groups) {
        most = 0;
        for (const uint size : sizes)
            most += divided_up(size, rounds * group_size_);
    }
    runs_ = arena.take<ObjectRun>(most, Use::scratch);
    first_runs_ = arena.take<uint>(sizes.size() + 1, Use::scratch);
    objects_ = arena.take<uint>(sizes.size(), Use::scratch);
}

void ObjectRuns::choose(const cl::CommandQueue& queue, std::span<const uint> lined_up,
                        std::span<const uint> others)
{
    std::vector<uint> objects(lined_up.begin(), lined_up.end());
    objects.insert(objects.end(), others.begin(), others.end());
    const auto triangles_of = [&](std::span<const uint> some) {
        uint sum = 0;
        for (const uint object : some)
            sum += sizes_[object];
        return sum;
    };
    triangles_ = triangles_of(objects);
    lined_up_triangles_ = triangles_of(lined_up);
    lined_up_objects_ = lined_up.size();
    const uint most = form_ == KernelForm::groups
                          ? rounds * group_size_
                          : std::max(1u, divided_up(triangles_, static_cast<uint>(chunks_)));
    std::vector<uint> firsts(sizes_.size());
    std::exclusive_scan(sizes_.begin(), sizes_.end(), firsts.begin(), 0u);
    std::vector<ObjectRun> runs;
    std::vector<uint> first_runs{0};
    uint lined_up_before = 0;
    for (std::size_t k = 0; k < objects.size(); ++k) {
        const uint first = firsts[objects[k]], size = sizes_[objects[k]];
        for (uint at = 0; at < size; at += most)
            runs.push_back({first + at, first + std::min(size, at + most), objects[k],
                            k < lined_up.size() ? first - lined_up_before : 0});
        lined_up_before += size;
        first_runs.push_back(static_cast<uint>(runs.size()));
    }
    count_ = runs.size();
    lined_up_count_ = first_runs[lined_up.size()];
    assert(count_ <= runs_.size());
    runs_.upload(queue, runs);
    first_runs_.upload(queue, first_runs);
    objects_.upload(queue, objects);
}

void ObjectRuns::choose_all(const cl::CommandQueue& queue)
{
    std::vector<uint> all(sizes_.size());
    std::iota(all.begin(), all.end(), 0u);
    choose(queue, all);
}

}  // namespace bvhbench
