// SPDX-License-Identifier: MIT
//
// What the builders of radix trees share, and what each of them adds.
#pragma once

#include <memory>

#include "baselines/radix/stored_nodes.h"
#include "builders/builder.h"
#include "builders/device_tree.h"
#include "builders/stages/codes.h"

namespace bvhbench {

/// The line of leaves that a radix tree is built over, in device memory.
struct RadixLeaves {
    uint count = 0;
    bool sorted = false;
    const BoxFormat* format = &float_boxes();
    Buffer<std::byte> boxes;  ///< in the format; in leaf order if sorted, else in mesh order
    Buffer<uint> ids;         ///< the triangle of each leaf
    Buffer<uint> codes;       ///< ascending

    std::size_t inner() const { return std::size_t{count} - 1; }  ///< nodes over them

    /// The least that reading all codes, or all boxes, moves.
    std::int64_t code_bytes() const { return static_cast<std::int64_t>(codes.bytes()); }
    std::int64_t box_bytes() const
    {
        return static_cast<std::int64_t>(boxes.bytes() + (sorted ? 0 : ids.bytes()));
    }
};

/// Memory for the inner nodes over `leaves`.
inline Buffer<std::byte> take_radix_nodes(Arena& arena, const RadixLeaves& leaves)
{
    return arena.take<std::byte>(leaves.inner() * radix_node_bytes(*leaves.format), Use::tree);
}

/// How kernels over leaves or nodes are launched: a work-item each in groups, or a run of them a work-item where
/// no more than `most_items` work-items are to share the work; 0 is no such bound. The kernels are the same:
/// own_chunk gives a work-item its one or its run.
struct RadixLaunch {
    std::size_t group_size = 1;
    std::size_t most_items = 0;

    /// What `options` ask for, else what suits the device. Throws BadUsage for a group it does not have.
    RadixLaunch(const Device& device, const BuildOptions& options);

    void operator()(Queue& queue, const cl::Kernel& kernel, uint count,
                    std::int64_t moved_bytes) const;
};

/// What kernels are compiled and launched with.
struct RadixSetup {
    Programs& programs;
    RadixLaunch launch;
    unsigned code_bits;
    bool sorted_leaves;
    const BoxFormat& format;

    cl::Kernel kernel(std::string_view path, const char* name) const
    {
        return programs.kernel(path, name,
                               {{"CODE_WORDS", code_words(code_bits)},
                                {"SORTED_LEAVES", sorted_leaves ? 1u : 0u},
                                {"BOX_FORMAT", format.number}});
    }
};

/// The stage after the leaves are in order, one way of it.
class RadixHierarchy {
public:
    virtual ~RadixHierarchy() = default;

    /// Take all memory besides the leaves'. `leaves` holds until the next plan.
    virtual void plan(Arena& arena, const RadixLeaves& leaves) = 0;

    /// Fill what builds expect and leave as it was. Waits.
    virtual void prepare(const cl::CommandQueue& queue) = 0;

    /// Enqueue topology and boxes, for two leaves at least. Does not wait.
    virtual void build(Queue& queue) = 0;

    /// Whether inner nodes have the numbers that node.h says, which tell where each object's root is.
    virtual bool numbers_by_range() const { return true; }

    /// Enqueue boxes only, over the topology that the last build left. As `build`.
    virtual void refit(Queue& queue) = 0;

    /// The inner nodes, the children's indices as stored, boxes read back by `rounding`; `root` is set to the root's.
    virtual std::vector<RadixNode> download(const cl::CommandQueue& queue,
                                            const BoxRounding& rounding, uint& root) const = 0;

    /// As DeviceTree says of the nodes; the leaves' parameters come behind.
    virtual std::string_view access_header() const { return "baselines/radix/access.clh"; }
    virtual cl_uint bind(cl::Kernel& kernel, cl_uint first) const = 0;
};

using MakeRadixHierarchy = std::unique_ptr<RadixHierarchy> (*)(const RadixSetup& setup);

/// A builder around one way of the hierarchy: leaf order before it, a tree after it.
std::unique_ptr<Builder> make_radix_builder(Programs& programs, const BuilderCard& card,
                                            MakeRadixHierarchy make, const BuildOptions& options);

}  // namespace bvhbench
