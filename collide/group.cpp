// SPDX-License-Identifier: MIT
#include <algorithm>

#include "collide/colliders.h"
#include "collide/device_collider.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr uint block_pairs = 512;  // a work-item's own, of the form for few cores

class Group final : public DeviceCollider {
public:
    Group(Programs& programs, const ColliderOptions& options)
        : DeviceCollider(programs,
                         {"group", "Neighbouring leaves as one query [Chitalu2020, Eq. 12]"},
                         options, 64)
    {}

private:
    void compile(const DeviceTree& tree) override
    {
        // One more than there are levels, for the way down from the last node. The chain that a query starts with
        // is as long at most, so that twice as much is enough for any tree, if not for speed.
        const uint reserve = tree.most_levels() + 1;
        const uint frontier = options_.capacity != 0 ? 2 * reserve : 2 * reserve + 6 * group_size_;
        walk_ =
            by_groups()
                ? kernel(
                      tree, "collide/group_groups.cl", "group_pairs",
                      {{"GROUP_SIZE", group_size_}, {"FRONTIER", frontier}, {"RESERVE", reserve}})
                : kernel(tree, "collide/group_chunks.cl", "group_pairs",
                         {{"SINK_BLOCK", block_pairs}});
    }

    void plan(Arena& arena, const DeviceTree&) override
    {
        if (!by_groups())
            blocks_ = arena.take<Pair>(block_pairs * chunks_, Use::scratch);
    }

    void enqueue(const DeviceTree& tree, const Input& input, Queue& queue) override
    {
        if (by_groups()) {
            bind(walk_, tree, input);
            queue.launch(walk_,
                         std::size_t{divided_up(tree.leaf_count(), group_size_)} * group_size_,
                         group_size_, 0);
        } else {
            bind(walk_, tree, input, blocks_);
            queue.launch(walk_, chunks_, 1, 0);
        }
    }

    cl::Kernel walk_;
    Buffer<Pair> blocks_;
};

}  // namespace

std::unique_ptr<Collider> make_group(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Group>(programs, options);
}

}  // namespace bvhbench
