// SPDX-License-Identifier: MIT
#include "builders/stages/object_bounds.h"

#include <cassert>
#include <numeric>

namespace bvhbench {
namespace {

constexpr auto path = "builders/stages/object_bounds.cl";

bool by_groups(const Device& device, KernelForm form)
{
    return chosen_form(device, form) == KernelForm::groups;
}

}  // namespace

ObjectBounds::ObjectBounds(Programs& programs, KernelForm form, uint group_size)
    : all_(programs.device(), form, group_size)
    , boxes_kernel_(programs, path,
                    by_groups(programs.device(), form) ? "runs_groups" : "runs_chunks",
                    {{"GROUP_SIZE", group_size}, {"ROUNDS", ObjectRuns::rounds}})
    , join_kernel_(programs.kernel(
          path, by_groups(programs.device(), form) ? "join_groups" : "join_chunks",
          {{"GROUP_SIZE", group_size}, {"ROUNDS", ObjectRuns::rounds}, {"SWEPT", 0}}))
{}

void ObjectBounds::plan(Arena& arena, std::span<const uint> sizes, Use boxes, bool of_all)
{
    boxes_ = arena.take<Aabb>(std::accumulate(sizes.begin(), sizes.end(), std::size_t{0}), boxes);
    all_.plan(arena, sizes);
    partials_ = arena.take<Bounds>(all_.runs().size(), Use::scratch);
    bounds_ = arena.take<Bounds>(sizes.size(), Use::scratch);
    bounds_of_all_ = arena.take<Bounds>(of_all ? 1 : 0, Use::scratch);
    all_objects_ = arena.take<uint>(of_all ? 2 : 0, Use::scratch);
    one_ = arena.take<uint>(of_all ? 1 : 0, Use::scratch);
}

void ObjectBounds::prepare(const cl::CommandQueue& queue)
{
    all_.choose_all(queue);
    if (bounds_of_all_.size() == 0)
        return;
    const uint ends[] = {0, static_cast<uint>(bounds_.size())}, place = 0;
    all_objects_.upload(queue, ends);
    one_.upload(queue, {&place, 1});
}

void ObjectBounds::enqueue_chosen(const Input& input, const ObjectRuns& chosen, Queue& queue)
{
    assert(input.triangle_count() == boxes_.size() && input.objects.size() == bounds_.size());
    if (chosen.count() == 0)
        return;
    // Of the points those of the chosen objects, of which an equal share is as good a guess as any.
    const double share =
        static_cast<double>(chosen.triangles()) / static_cast<double>(boxes_.size());
    const auto moved =
        static_cast<double>(input.point_bytes() + input.device_faces.bytes() + boxes_.bytes());
    queue.launch(boxes_kernel_.bound(input, input.device_faces, boxes_, partials_, chosen.runs()),
                 chosen.count() * chosen.group(), chosen.group(),
                 static_cast<std::int64_t>(share * moved));
    if (chosen.lined_up_objects() == 0)
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

}  // namespace bvhbench
