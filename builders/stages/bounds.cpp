// SPDX-License-Identifier: MIT
#include "builders/stages/bounds.h"

#include <algorithm>
#include <cassert>

#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr auto path = "builders/stages/bounds.cl";

/// Groups that keep every compute unit busy; more would only leave more partials to join.
std::size_t most_groups(const Device& device)
{
    return device.tuned(bounds_groups_per_unit) *
           std::size_t{device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>()};
}

}  // namespace

BoundsStage::BoundsStage(Programs& programs, KernelForm form, uint group_size)
    : form_(chosen_form(programs.device(), form))
    , group_size_(group_size != 0 || form_ == KernelForm::chunks
                      ? std::max(1u, group_size)
                      : programs.device().tuned(bounds_group_size))
    , groups_meet_(form_ == KernelForm::groups && programs.device().lets_groups_meet())
    , most_partials_(form_ == KernelForm::groups ? most_groups(programs.device())
                                                 : chunk_count(programs.device()))
    , boxes_kernel_(programs, path, form_ == KernelForm::groups ? "bounds_groups" : "bounds_chunks",
                    {{"GROUP_SIZE", group_size_}})
    , join_kernel_(programs.kernel(path,
                                   form_ == KernelForm::groups ? "join_groups" : "join_chunks",
                                   {{"GROUP_SIZE", group_size_}, {"SWEPT", 0}}))
{}

std::size_t BoundsStage::partial_count(std::size_t primitives) const
{
    const uint per_partial = form_ == KernelForm::groups ? group_size_ : 1;
    return std::min<std::size_t>(divided_up(static_cast<uint>(primitives), per_partial),
                                 most_partials_);
}

void BoundsStage::plan(Arena& arena, std::size_t primitives, Use boxes)
{
    boxes_ = arena.take<Aabb>(primitives, boxes);
    partials_ = arena.take<Bounds>(partial_count(primitives), Use::scratch);
    bounds_ = arena.take<Bounds>(1, Use::scratch);
    arrivals_ = arena.take<uint>(1, Use::scratch);
}

void BoundsStage::prepare(const cl::CommandQueue& queue)
{
    const uint none = 0;
    arrivals_.upload(queue, {&none, 1});
}

void BoundsStage::enqueue(const Input& input, Queue& queue)
{
    const uint count = input.triangle_count();
    assert(count > 0 && count == boxes_.size());
    const auto partials = static_cast<uint>(partials_.size());
    const auto moved = static_cast<std::int64_t>(input.point_bytes() + input.device_faces.bytes() +
                                                 boxes_.bytes());

    queue.begin("bounds");
    if (form_ == KernelForm::groups) {
        const uint rounds = divided_up(count, group_size_ * partials);
        queue.launch(boxes_kernel_.bound(input, input.device_faces, boxes_, partials_, bounds_,
                                         arrivals_, count, rounds, groups_meet_ ? 1u : 0u),
                     partials_.size() * group_size_, group_size_, moved);
    } else {
        queue.launch(boxes_kernel_.bound(input, input.device_faces, boxes_, partials_, count),
                     partials_.size(), 1, moved);
    }
    if (groups_meet_)
        return;
    set_arguments(join_kernel_, partials_, bounds_, partials);
    const uint join_size = form_ == KernelForm::groups ? group_size_ : 1;
    queue.launch(join_kernel_, join_size, join_size,
                 static_cast<std::int64_t>(partials_.bytes() + bounds_.bytes()));
}

Bounds host_bounds(std::span<const Aabb> boxes)
{
    Bounds bounds = empty_bounds();
    for (const Aabb& box : boxes)
        bounds = grown(bounds, box);
    return bounds;
}

}  // namespace bvhbench
