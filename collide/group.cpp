// SPDX-License-Identifier: MIT
#include "collide/colliders.h"
#include "collide/walk_collider.h"

namespace bvhbench {
namespace {

constexpr uint loose = 2;  // times the area of leaves together, from which on their common box says too little

class Group final : public WalkCollider {
public:
    Group(Programs& programs, const ColliderOptions& options)
        : WalkCollider(programs,
                       {"group", "Neighbouring leaves as one query [Chitalu2020, Eq. 12]"}, options)
    {}

private:
    cl::Kernel walk_kernel(const DeviceTree& tree) const override
    {
        // One more than there are levels, for the way down from the last node. The chain that a query starts with
        // is as long at most, so that twice as much is enough for any tree, if not for speed.
        const uint reserve = tree.most_levels() + 1;
        const uint frontier = options_.capacity != 0 ? 2 * reserve : 2 * reserve + 6 * group_size_;
        return by_groups() ? kernel(tree, "collide/group_groups.cl", "group_pairs",
                                    {{"GROUP_SIZE", group_size_},
                                     {"FRONTIER", frontier},
                                     {"RESERVE", reserve},
                                     {"LOOSE", loose}},
                                    Optimise::on_gpus)
                           : kernel(tree, "collide/group_chunks.cl", "group_pairs",
                                    {{"TASK_LEAVES", chunk_task_leaves},
                                     {"SKIP_OVERLAP", skips(skip_overlap) ? 1u : 0u}});
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
