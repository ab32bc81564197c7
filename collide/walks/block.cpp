// SPDX-License-Identifier: MIT
#include "collide/colliders.h"
#include "collide/parameters.h"
#include "collide/walks/walk_collider.h"

namespace bvhbench {
namespace {

constexpr uint block_leaves = 32;  // of which a task's subtree has five levels
constexpr uint warp_lanes = 32;    // LANES of builders/stages/sort/peers.clh, on NVIDIA's

class Block final : public WalkCollider {
public:
    Block(Programs& programs, const ColliderOptions& options)
        : WalkCollider(programs, {"block", "Blocks of leaves against blocks [Chitalu2020, Eq. 12]"},
                       options, group_group_size)
        , has_warps_(programs.device().lets_groups_wait())
    {}

    std::string refusal(const Tree& tree) const override
    {
        const auto* on_device = dynamic_cast<const DeviceTree*>(&tree);
        if (on_device != nullptr && (!on_device->is_implicit() || on_device->child_bits() != 1))
            return "block needs a binary implicit tree, whose blocks of leaves are subtrees";
        return DeviceCollider::refusal(tree);
    }

private:
    uint lanes() const { return has_warps_ ? warp_lanes : 1; }
    uint teams() const { return has_warps_ ? device().tuned(block_teams) : 1; }

    Shape shape() const override
    {
        if (by_groups())
            return {block_leaves, lanes(), teams() * lanes()};
        return WalkCollider::shape();
    }

    cl::Kernel walk_kernel(const DeviceTree& tree) const override
    {
        if (!by_groups())  // few cores have no warps: as group
            return lined_up_kernel(tree);
        return kernel(
            tree, "collide/walks/block.cl", "block_pairs",
            {{"TEAMS", teams()}, {"BLOCK", block_leaves}, {"LOOSE", device().tuned(block_loose)}},
            Optimise::on_gpus);
    }

    uint queue_count(const DeviceTree&) const override { return by_groups() ? 0 : 1; }
    bool has_blocks() const override { return false; }

    bool has_warps_;
};

}  // namespace

std::unique_ptr<Collider> make_block(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Block>(programs, options);
}

}  // namespace bvhbench
