// SPDX-License-Identifier: MIT
#include "collide/walk_collider.h"

#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr uint usual_group_size = 64;

}  // namespace

WalkCollider::WalkCollider(Programs& programs, const ColliderCard& card,
                           const ColliderOptions& options)
    : DeviceCollider(programs, card, options, usual_group_size)
{}

void WalkCollider::plan(Arena& arena, const DeviceTree&)
{
    if (!by_groups())
        blocks_ = arena.take<Pair>(block_pairs * chunks_, Use::scratch);
}

void WalkCollider::enqueue(const DeviceTree& tree, const Input& input, Queue& queue)
{
    if (by_groups()) {
        bind(walk_, tree, input);
        queue.launch(walk_, std::size_t{divided_up(tree.leaf_count(), group_size_)} * group_size_,
                     group_size_, 0);
    } else {
        bind(walk_, tree, input, blocks_);
        queue.launch(walk_, chunks_, 1, 0);
    }
}

}  // namespace bvhbench
