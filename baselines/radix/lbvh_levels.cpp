// SPDX-License-Identifier: MIT
#include <algorithm>

#include "baselines/baselines.h"
#include "baselines/radix/hierarchy.h"
#include "geometry/bits.h"

namespace bvhbench {
namespace {

/// Work-items that fill any device we know. A launch for a deep level must allow for half as many nodes as there
/// are leaves and mostly finds few or none: work-items that only look and leave would be most of its time.
std::size_t most_lanes(const Device& device)
{
    return 2048 * std::size_t{device.cl.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>()};
}

class LbvhLevels final : public RadixHierarchy {
public:
    explicit LbvhLevels(const RadixSetup& setup)
        : RadixHierarchy(setup)
        , code_bits_(setup.code_bits)
        , split_(setup.kernel("baselines/radix/lbvh_levels.cl", "split_level"))
        , box_(setup.kernel("baselines/radix/lbvh_levels.cl", "box_level"))
    {
        if (launch_.most_items == 0)
            launch_.most_items = most_lanes(setup.programs.device());
    }

    void plan(Arena& arena) override
    {
        // On the way down from the root every node splits at a bit of the key that is below its parent's, and
        // of a place only so many bits differ.
        levels_ = std::min(leaves_.count - 1, code_bits_ + ceil_log2(leaves_.count));
        nodes_ = take_nodes(arena);
        begins_ = arena.take<uint>(levels_ + 1, Use::scratch);
        counts_ = arena.take<uint>(levels_ + 1, Use::scratch);
    }

    void prepare(const cl::CommandQueue& queue) override
    {
        std::vector<uint> counts(counts_.size(), 0u);
        counts.front() = 1;  // the root
        counts_.upload(queue, counts);
        begins_.upload(queue, std::vector<uint>(begins_.size(), 0u));
    }

    void build(Queue& queue) override
    {
        for (uint level = 0; level < levels_; ++level) {
            set_arguments(split_, leaves_.codes, nodes_, begins_, counts_, leaves_.count, level);
            launch_(queue, split_, most_nodes_on(level),
                    level == 0 ? leaves_.codes.bytes() + nodes_.bytes() : 0);
        }
        refit(queue);
    }

    /// How many bytes a level moves the host does not know: the root's launch declares all levels'.
    void refit(Queue& queue) override
    {
        for (uint level = levels_; level-- > 0;) {
            set_arguments(box_, leaves_.boxes, leaves_.ids, nodes_, begins_, counts_, level);
            launch_(queue, box_, most_nodes_on(level),
                    level == 0 ? leaves_.box_bytes() + child_bytes() + nodes_.bytes() : 0);
        }
    }

    bool numbers_by_range() const override { return false; }

private:
    /// Every inner node has two leaves at least.
    uint most_nodes_on(uint level) const
    {
        return std::min(leaves_.count / 2, 1u << std::min(level, 31u));
    }

    uint code_bits_;
    cl::Kernel split_, box_;
    uint levels_ = 0;      ///< of inner nodes, at most; `nodes_` has them level by level
    Buffer<uint> begins_;  ///< where each level begins in the nodes, and where the last ends
    Buffer<uint> counts_;  ///< of nodes, one a level and one more
};

}  // namespace

std::unique_ptr<Builder> make_lbvh_levels(Programs& programs, const BuildOptions& options)
{
    return make_radix_builder<LbvhLevels>(
        programs, "lbvh-levels", "Binary radix tree, a launch a level [Lauterbach2009]", options);
}

}  // namespace bvhbench
