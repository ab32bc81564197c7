// SPDX-License-Identifier: MIT
#include "builders/stages/bounds.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "geometry/bits.h"

namespace bvhbench {
namespace {

/// Keeps every compute unit busy; more would only add partials to join.
constexpr std::size_t groups_per_unit = 8;

std::size_t most_groups(const Device& device)
{
    return groups_per_unit * std::size_t{device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>()};
}

}  // namespace

BoundsStage::BoundsStage(Programs& programs, KernelForm form, uint group_size)
    : programs_(programs)
    , form_(chosen_form(programs.device(), form))
    , group_size_(group_size != 0 || !by_groups() ? std::max(1u, group_size)
                                                  : programs.device().tuned(bounds_group_size))
    , groups_meet_(by_groups() && programs.device().lets_groups_meet())
    , most_partials_(by_groups() ? most_groups(programs.device()) : chunk_count(programs.device()))
    , all_(programs.device(), form_, group_size != 0 ? group_size : ObjectRuns::usual_group_size)
{}

cl::Kernel BoundsStage::kernel(const char* of_groups, const char* of_chunks,
                               unsigned is_swept) const
{
    return programs_.kernel("builders/stages/bounds.cl", by_groups() ? of_groups : of_chunks,
                            {{"GROUP_SIZE", is_forest() ? all_.group_size() : group_size_},
                             {"ROUNDS", ObjectRuns::rounds},
                             {"SWEPT", is_swept}});
}

template <class... Arguments>
cl::Kernel& BoundsStage::boxes_kernel(const Input& input, const Arguments&... more)
{
    if (!input.is_swept())
        return set_arguments(of_frame_, input.device_points, more...);
    if (!swept_)
        swept_ = is_forest() ? kernel("runs_groups", "runs_chunks", 1)
                             : kernel("bounds_groups", "bounds_chunks", 1);
    return set_arguments(*swept_, input.device_points, input.device_end_points, more...);
}

void BoundsStage::plan(Arena& arena, std::size_t primitives, Use boxes)
{
    const auto size = static_cast<uint>(primitives);
    plan(arena, {&size, 1}, boxes);
}

void BoundsStage::plan(Arena& arena, std::span<const uint> sizes, Use boxes, bool of_all)
{
    const auto primitives = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
    boxes_ = arena.take<Aabb>(primitives, boxes);
    bounds_ = arena.take<Bounds>(sizes.size(), Use::scratch);
    swept_.reset();
    if (!is_forest()) {
        const uint per_partial = by_groups() ? group_size_ : 1;
        const std::size_t partials = divided_up(static_cast<uint>(primitives), per_partial);
        partials_ = arena.take<Bounds>(std::min(partials, most_partials_), Use::scratch);
        arrivals_ = arena.take<uint>(1, Use::scratch);
        of_frame_ = kernel("bounds_groups", "bounds_chunks", 0);
        join_kernel_ = kernel("join_groups", "join_chunks", 0);
        return;
    }
    all_.plan(arena, sizes);
    partials_ = arena.take<Bounds>(all_.runs().size(), Use::scratch);
    bounds_of_all_ = arena.take<Bounds>(of_all ? 1 : 0, Use::scratch);
    all_objects_ = arena.take<uint>(of_all ? 2 : 0, Use::scratch);
    one_ = arena.take<uint>(of_all ? 1 : 0, Use::scratch);
    of_frame_ = kernel("runs_groups", "runs_chunks", 0);
    join_kernel_ = kernel("join_objects_groups", "join_objects_chunks", 0);
}

void BoundsStage::prepare(const cl::CommandQueue& queue)
{
    const uint none = 0;
    if (!is_forest()) {
        arrivals_.upload(queue, {&none, 1});
        return;
    }
    all_.choose_all(queue);
    if (bounds_of_all_.size() == 0)
        return;
    const uint ends[] = {0, static_cast<uint>(bounds_.size())};
    all_objects_.upload(queue, ends);
    one_.upload(queue, {&none, 1});
}

void BoundsStage::enqueue(const Input& input, Queue& queue, std::string_view stage, bool joins)
{
    assert(input.triangle_count() == boxes_.size());
    assert(!is_forest() || input.objects.size() == bounds_.size());
    queue.begin(stage);
    if (is_forest())
        enqueue_chosen(input, all_, joins, queue);
    else
        enqueue_one(input, queue);
}

void BoundsStage::enqueue(const Input& input, const ObjectRuns& chosen, Queue& queue)
{
    queue.begin("bounds");
    enqueue_chosen(input, chosen, chosen.lined_up_objects() > 0, queue);
}

void BoundsStage::enqueue_one(const Input& input, Queue& queue)
{
    const uint count = input.triangle_count();
    const auto partials = static_cast<uint>(partials_.size());
    const auto moved = static_cast<std::int64_t>(input.point_bytes() + input.device_faces.bytes() +
                                                 boxes_.bytes());
    const std::size_t group = by_groups() ? group_size_ : 1;
    const uint rounds = divided_up(count, group_size_ * partials);
    cl::Kernel& boxes = by_groups()
                            ? boxes_kernel(input, input.device_faces, boxes_, partials_, bounds_,
                                           arrivals_, count, rounds, groups_meet_ ? 1u : 0u)
                            : boxes_kernel(input, input.device_faces, boxes_, partials_, count);
    queue.launch(boxes, partials * group, group, moved);
    if (groups_meet_)
        return;
    queue.launch(set_arguments(join_kernel_, partials_, bounds_, partials), group, group,
                 static_cast<std::int64_t>(partials_.bytes() + bounds_.bytes()));
}

void BoundsStage::enqueue_chosen(const Input& input, const ObjectRuns& chosen, bool joins,
                                 Queue& queue)
{
    if (chosen.count() == 0)
        return;
    // The bytes of the chosen objects' points are estimated as a proportional share of all.
    const double share =
        static_cast<double>(chosen.triangles()) / static_cast<double>(boxes_.size());
    const auto moved =
        static_cast<double>(input.point_bytes() + input.device_faces.bytes() + boxes_.bytes());
    queue.launch(boxes_kernel(input, input.device_faces, boxes_, partials_, chosen.runs()),
                 chosen.count() * chosen.group(), chosen.group(),
                 static_cast<std::int64_t>(share * moved));
    if (!joins)
        return;
    set_arguments(join_kernel_, partials_, bounds_, chosen.first_runs(), chosen.objects());
    queue.launch(join_kernel_, chosen.lined_up_objects() * chosen.group(), chosen.group(),
                 static_cast<std::int64_t>((chosen.lined_up_count() + chosen.lined_up_objects()) *
                                           sizeof(Bounds)));
    if (bounds_of_all_.size() == 0)
        return;
    set_arguments(join_kernel_, bounds_, bounds_of_all_, all_objects_, one_);
    queue.launch(join_kernel_, chosen.group(), chosen.group(),
                 static_cast<std::int64_t>(bounds_.bytes() + bounds_of_all_.bytes()));
}

Bounds host_bounds(std::span<const Aabb> boxes)
{
    Bounds bounds = empty_bounds();
    for (const Aabb& box : boxes)
        bounds = grown(bounds, box);
    return bounds;
}

}  // namespace bvhbench
