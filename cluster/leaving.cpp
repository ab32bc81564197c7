// SPDX-License-Identifier: MIT
#include "cluster/leaving.h"

#include "collide/device_lists.h"
#include "collide/parameters.h"

namespace bvhbench {
namespace {

constexpr std::size_t leaving_at_first = 4096;  // triangles that leave; grows

}  // namespace

Leaving::Leaving(Programs& programs)
    : DeviceCollider(programs, {"leaving", "Triangles that meet boxes of other ranks"},
                     {.capacity = leaving_at_first}, leaf_group_size, Wants::no_tree)
{}

void Leaving::want(const WantedBoxes& wanted, Queue& queue)
{
    std::vector<Aabb> boxes = wanted.boxes;
    boxes.push_back(wanted.around);
    if (boxes_.size() < boxes.size())
        take_memory(wanted_arena_, device(), [&](Arena& arena) {
            boxes_ = arena.take<Aabb>(boxes.size(), Use::scratch);
            ranks_ = arena.take<uint>(wanted.boxes.size(), Use::scratch);
        });
    boxes_.upload(queue.cl(), boxes);
    ranks_.upload(queue.cl(), wanted.ranks);
    wanted_count_ = static_cast<uint>(wanted.boxes.size());
}

void Leaving::compile(const Input&)
{
    kernel_ = programs().kernel("cluster/leaving.cl", "leaving",
                                {{"GROUP_SIZE", group_size_}, {"KEEP_ADJACENT", 1u}});
}

std::int64_t Leaving::reads_at_least() const
{
    return static_cast<std::int64_t>(std::size_t{triangles_} * (sizeof(Face) + sizeof(Point)));
}

void Leaving::enqueue(const Input& input, Queue& queue)
{
    set_arguments(kernel_, input.device_points, input.device_faces, triangles_, boxes_, ranks_,
                  wanted_count_, pairs_, static_cast<uint>(pairs_.size()), counters_);
    launch(kernel_, triangles_, group_size_, queue);
}

}  // namespace bvhbench
