// SPDX-License-Identifier: MIT
#include "collide/colliders.h"
#include "collide/walks/walk_collider.h"

namespace bvhbench {
namespace {

class Group final : public WalkCollider {
public:
    Group(Programs& programs, const ColliderOptions& options)
        : WalkCollider(programs,
                       {"group", "Neighbouring leaves as one query [Chitalu2020, Eq. 12]"}, options,
                       group_group_size)
    {}

private:
    /// That a group's frontier has room for beyond what it cannot do without.
    uint frontier_nodes() const { return device().tuned(group_frontier_per_item) * group_size_; }

    cl::Kernel walk_kernel(const DeviceTree& tree) const override
    {
        if (!by_groups())
            return lined_up_kernel(tree);
        if (tree.child_bits() > 1)
            return wide_kernel(tree);
        // One more than there are levels, for the way down from the last node. The chain that a query starts with
        // is as long at most, so that twice as much is enough for any tree, if not for speed.
        const uint reserve = tree.most_levels() + 1;
        const uint frontier = options_.capacity != 0 ? 2 * reserve : 2 * reserve + frontier_nodes();
        return kernel(tree, "collide/walks/group_groups.cl", "group_pairs",
                      {{"GROUP_SIZE", group_size_},
                       {"FRONTIER", frontier},
                       {"RESERVE", reserve},
                       {"LOOSE", device().tuned(group_loose)}},
                      Optimise::on_gpus);
    }

    cl::Kernel wide_kernel(const DeviceTree& tree) const
    {
        // A node taken on each level leaves its other children waiting, and a query starts with a node a level.
        const uint reserve = (tree.most_levels() << tree.child_bits()) + 1;
        const uint frontier = options_.capacity != 0 ? 2 * reserve : 2 * reserve + 4 * group_size_;
        return kernel(tree, "collide/walks/group_wide_groups.cl", "group_pairs",
                      {{"GROUP_SIZE", group_size_},
                       {"FRONTIER", frontier},
                       {"RESERVE", reserve},
                       {"LOOSE", device().tuned(group_loose)}},
                      Optimise::on_gpus);
    }

    // The one of TASKS_BEGUN.
    uint queue_count(const DeviceTree&) const override { return by_groups() ? 0 : 1; }
    bool has_blocks() const override { return false; }
};

}  // namespace

std::unique_ptr<Collider> make_group(Programs& programs, const ColliderOptions& options)
{
    return std::make_unique<Group>(programs, options);
}

}  // namespace bvhbench
