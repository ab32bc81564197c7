// SPDX-License-Identifier: MIT
#include "builders/stages/object_bounds.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr auto path = "builders/stages/object_bounds.cl";
constexpr uint rounds = 4;  // of a group's size each, that a run takes at most

}  // namespace

ObjectBounds::ObjectBounds(Programs& programs, KernelForm form, uint group_size)
    : form_(chosen_form(programs.device(), form))
    , group_size_(group_size)
    , chunks_(chunk_count(programs.device()))
{
    const bool groups = form_ == KernelForm::groups;
    boxes_kernel_ = programs.kernel(path, groups ? "runs_groups" : "runs_chunks",
                                    {{"GROUP_SIZE", group_size_}, {"ROUNDS", rounds}});
    join_kernel_ = programs.kernel(path, groups ? "join_groups" : "join_chunks",
                                   {{"GROUP_SIZE", group_size_}, {"ROUNDS", rounds}});
}

void ObjectBounds::plan(Arena& arena, std::span<const uint> sizes, Use boxes)
{
    const uint total = std::accumulate(sizes.begin(), sizes.end(), 0u);
    const uint most = form_ == KernelForm::groups
                          ? rounds * group_size_
                          : std::max(1u, divided_up(total, static_cast<uint>(chunks_)));
    run_list_.clear();
    first_run_list_.assign(1, 0);
    uint first = 0;
    for (const uint size : sizes) {
        assert(size > 0);
        for (uint at = 0; at < size; at += most)
            run_list_.push_back({first + at, first + std::min(size, at + most)});
        first += size;
        first_run_list_.push_back(static_cast<uint>(run_list_.size()));
    }
    boxes_ = arena.take<Aabb>(total, boxes);
    runs_ = arena.take<Run>(run_list_.size(), Use::scratch);
    first_runs_ = arena.take<uint>(first_run_list_.size(), Use::scratch);
    partials_ = arena.take<Bounds>(run_list_.size(), Use::scratch);
    bounds_ = arena.take<Bounds>(sizes.size(), Use::scratch);
}

void ObjectBounds::prepare(const cl::CommandQueue& queue)
{
    runs_.upload(queue, run_list_);
    first_runs_.upload(queue, first_run_list_);
}

void ObjectBounds::enqueue(const Input& input, Queue& queue, std::string_view stage)
{
    assert(input.triangle_count() == boxes_.size() && input.objects.size() == bounds_.size());
    const std::size_t group = form_ == KernelForm::groups ? group_size_ : 1;
    queue.begin(stage);
    set_arguments(boxes_kernel_, input.device_points, input.device_faces, boxes_, partials_, runs_);
    queue.launch(boxes_kernel_, runs_.size() * group, group,
                 static_cast<std::int64_t>(input.device_points.bytes() +
                                           input.device_faces.bytes() + boxes_.bytes()));
    set_arguments(join_kernel_, partials_, bounds_, first_runs_);
    queue.launch(join_kernel_, bounds_.size() * group, group,
                 static_cast<std::int64_t>(partials_.bytes() + bounds_.bytes()));
}

}  // namespace bvhbench
