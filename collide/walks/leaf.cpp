// SPDX-License-Identifier: MIT
#include "collide/colliders.h"
#include "collide/walks/walk_collider.h"

namespace bvhbench {
namespace {

class Leaf final : public WalkCollider {
public:
    Leaf(Programs& programs, const ColliderOptions& options)
        : WalkCollider(programs, {"leaf", "Leaf against tree, without a stack [Prokopenko2024]"},
                       options, leaf_group_size)
    {}

private:
    cl::Kernel walk_kernel(const DeviceTree& tree) const override
    {
        return by_groups() ? kernel(tree, "collide/walks/leaf_groups.cl", "leaf_pairs",
                                    {{"GROUP_SIZE", group_size_}})
                           : kernel(tree, "collide/walks/leaf_chunks.cl", "leaf_pairs",
                                    {{"SINK_BLOCK", block_pairs()}});
    }
};

}  // namespace

std::unique_ptr<Collider> make_leaf(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Leaf>(programs, options);
}

}  // namespace bvhbench
