// SPDX-License-Identifier: MIT
#include "collide/colliders.h"
#include "collide/device_collider.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

constexpr uint block_pairs =
    512;  // a work-item's own, of the form for few cores: half of its fastest cache

class Leaf final : public DeviceCollider {
public:
    Leaf(Programs& programs, const ColliderOptions& options)
        : DeviceCollider(programs, {"leaf", "Leaf against tree, without a stack [Prokopenko2024]"},
                         options, 64)
    {}

private:
    void compile(const DeviceTree& tree) override
    {
        walk_ = by_groups() ? kernel(tree, "collide/leaf_groups.cl", "leaf_pairs",
                                     {{"GROUP_SIZE", group_size_}})
                            : kernel(tree, "collide/leaf_chunks.cl", "leaf_pairs",
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

std::unique_ptr<Collider> make_leaf(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Leaf>(programs, options);
}

}  // namespace bvhbench
