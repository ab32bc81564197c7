// SPDX-License-Identifier: MIT
#include <algorithm>

#include "baselines/baselines.h"
#include "baselines/radix/builder.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

/// Returns a number of work-items that fills any known device. A launch for a deep level must allow for half as many nodes as
/// there are leaves but mostly finds few or none, so one work-item per possible node would mostly cost idle work-items.
std::size_t most_lanes(const Device& device)
{
    return 2048 * std::size_t{device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>()};
}

/// [Lauterbach2009]. Where groups may wait for each other, all levels are in one launch; elsewhere each is a launch of its own.
class LbvhLevels final : public RadixBuilder {
public:
    LbvhLevels(Programs& programs, const BuildOptions& options)
        : RadixBuilder(programs, "lbvh-levels",
                       "Binary radix tree, level by level [Lauterbach2009]", make_lbvh_levels,
                       options)
        , code_bits_(leaf_order_.code_bits())
        , groups_at_once_(most_groups_at_once(programs.device()))
    {
        searches_roots_ = true;
        if (is_at_once()) {
            build_ = kernel("baselines/radix/levels_at_once.cl", "build_at_once");
            boxes_ = kernel("baselines/radix/levels_at_once.cl", "boxes_at_once");
            most_items_ = groups_at_once_ * group_size_;
            return;
        }
        split_ = kernel("baselines/radix/lbvh_levels.cl", "split_level");
        box_ = kernel("baselines/radix/lbvh_levels.cl", "box_level");
        if (most_items_ == 0)
            most_items_ = most_lanes(programs.device());
    }

private:
    void plan_nodes(Arena& arena) override
    {
        // Each node splits at a lower bit of the key than its parent; only ceil(log2(leaves)) bits of a place differ.
        levels_ = std::min(tree_.leaves - 1, code_bits_ + ceil_log2(tree_.leaves));
        tree_.nodes = take_nodes(arena);
        begins_ = arena.take<uint>(levels_ + 1, Use::scratch);
        counts_ = arena.take<uint>(levels_ + 1, Use::scratch);
        waits_ = arena.take<cl_ulong>(groups_at_once_, Use::scratch);
    }

    void prepare_nodes(const cl::CommandQueue& queue) override
    {
        std::vector<uint> counts(counts_.size(), 0u);
        counts.front() = 1;  // the root
        counts_.upload(queue, counts);
        begins_.upload(queue, std::vector<uint>(begins_.size(), 0u));
        waits_.upload(queue, std::vector<cl_ulong>(waits_.size(), 0u));
        epoch_ = 1;
    }

    void build_nodes(Queue& queue) override
    {
        if (is_at_once()) {
            set_arguments(build_, tree_.codes, tree_.leaf_boxes, tree_.ids, tree_.nodes, begins_,
                          counts_, waits_, tree_.leaves, next_epoch());
            launch(queue, build_, tree_.leaves / 2,
                   tree_.codes.bytes() + box_bytes() + tree_.nodes.bytes());
            return;
        }
        for (uint level = 0; level < levels_; ++level) {
            set_arguments(split_, tree_.codes, tree_.nodes, begins_, counts_, tree_.leaves, level);
            launch(queue, split_, most_nodes_on(level),
                   level == 0 ? tree_.codes.bytes() + tree_.nodes.bytes() : 0);
        }
        refit_nodes(queue);
    }

    /// Declares the bytes of all levels with the root's launch, since the host does not know how many bytes each level moves.
    void refit_nodes(Queue& queue) override
    {
        if (is_at_once()) {
            set_arguments(boxes_, tree_.leaf_boxes, tree_.ids, tree_.nodes, begins_, waits_,
                          tree_.leaves, next_epoch());
            launch(queue, boxes_, tree_.leaves / 2,
                   box_bytes() + child_bytes() + tree_.nodes.bytes());
            return;
        }
        for (uint level = levels_; level-- > 0;) {
            set_arguments(box_, tree_.leaf_boxes, tree_.ids, tree_.nodes, begins_, counts_, level);
            launch(queue, box_, most_nodes_on(level),
                   level == 0 ? box_bytes() + child_bytes() + tree_.nodes.bytes() : 0);
        }
    }

    /// Returns an upper bound of the inner nodes on a level. Each has at least two leaves.
    uint most_nodes_on(uint level) const
    {
        return std::min(tree_.leaves / 2, 1u << std::min(level, 31u));
    }

    /// Returns how many groups may wait for each other: as many as are resident for certain. On a CPU, where levels are at once in
    /// tests only, a single group waits for nothing.
    static std::size_t most_groups_at_once(const Device& device)
    {
        const bool waits = device.lets_groups_wait();
        if (!(waits || device.is_cpu()) || device.tuned(levels_at_once) == 0)
            return 0;
        return waits ? device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>() : 1;
    }

    bool is_at_once() const { return groups_at_once_ != 0; }

    /// Returns the first of as many numbers as a launch waits at most.
    cl_ulong next_epoch()
    {
        epoch_ += 2 * cl_ulong{levels_};
        return epoch_ - 2 * cl_ulong{levels_};
    }

    uint code_bits_;
    std::size_t groups_at_once_;  ///< 0: each level is a launch
    cl::Kernel split_, box_, build_, boxes_;
    uint levels_ = 0;         ///< upper bound of the levels of inner nodes
    Buffer<uint> begins_;     ///< index of the first node of each level, and the end of the last
    Buffer<uint> counts_;     ///< number of nodes of each level, and one entry more
    Buffer<cl_ulong> waits_;  ///< of each group, the number of its last wait
    cl_ulong epoch_ = 1;      ///< number of the next wait
};

}  // namespace

std::unique_ptr<Builder> make_lbvh_levels(Programs& programs, const BuildOptions& options)
{
    return std::make_unique<LbvhLevels>(programs, options);
}

}  // namespace bvhbench
