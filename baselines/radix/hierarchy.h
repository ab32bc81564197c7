// SPDX-License-Identifier: MIT
//
// What the builders of radix trees share, and what each of them adds.
#pragma once

#include <memory>

#include "baselines/radix/node.h"
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

    /// The least that reading all boxes moves.
    std::size_t box_bytes() const { return boxes.bytes() + (sorted ? 0 : ids.bytes()); }
};

/// How kernels over leaves or nodes are launched: a work-item each in groups, or a run of them a work-item where
/// no more than `most_items` work-items are to share the work; 0 is no such bound. The kernels are the same:
/// own_chunk gives a work-item its one or its run.
struct RadixLaunch {
    std::size_t group_size = 1;
    std::size_t most_items = 0;

    /// What `options` ask for, else what suits the device. Throws BadUsage for a group it does not have.
    RadixLaunch(const Device& device, const BuildOptions& options);

    void operator()(Queue& queue, const cl::Kernel& kernel, uint count,
                    std::size_t moved_bytes) const;
};

/// What kernels are compiled and launched with.
struct RadixSetup {
    Programs& programs;
    RadixLaunch launch;
    unsigned code_bits;
    const RadixLeaves& leaves;  ///< their order and format stand; buffers come with each plan

    cl::Kernel kernel(std::string_view path, const char* name) const
    {
        return programs.kernel(path, name,
                               {{"CODE_WORDS", code_words(code_bits)},
                                {"SORTED_LEAVES", leaves.sorted ? 1u : 0u},
                                {"BOX_FORMAT", leaves.format->number}});
    }
};

/// The stage after the leaves are in order, one way of it.
class RadixHierarchy {
public:
    explicit RadixHierarchy(const RadixSetup& setup) : launch_(setup.launch), leaves_(setup.leaves)
    {}
    virtual ~RadixHierarchy() = default;

    /// Take all memory besides the leaves'.
    virtual void plan(Arena& arena) = 0;

    /// Fill what builds expect and leave as it was. Waits.
    virtual void prepare(const cl::CommandQueue& queue);

    /// Enqueue topology and boxes, for two leaves at least. Does not wait.
    virtual void build(Queue& queue) = 0;

    /// Whether inner nodes have the numbers that node.h says, which tell where each object's root is.
    virtual bool numbers_by_range() const { return true; }

    /// Enqueue boxes only, over the topology that the last build left. As `build`.
    virtual void refit(Queue& queue) = 0;

    /// The inner nodes, the children's indices as stored, boxes read back by `rounding`; `root` is set to the root's.
    virtual std::vector<RadixNode> download(const cl::CommandQueue& queue,
                                            const BoxRounding& rounding, uint& root) const;

    /// As DeviceTree says of the nodes; the leaves' parameters come behind.
    virtual std::string_view access_header() const { return "baselines/radix/access.clh"; }
    virtual cl_uint bind(cl::Kernel& kernel, cl_uint first) const
    {
        return set_arguments_from(kernel, first, nodes_);
    }

protected:
    /// Memory for inner nodes as node_words.clh stores them.
    Buffer<std::byte> take_nodes(Arena& arena) const;

    /// Bytes of the children's indices of all inner nodes.
    std::size_t child_bytes() const { return leaves_.inner() * 2 * sizeof(uint); }

    RadixLaunch launch_;
    const RadixLeaves& leaves_;
    Buffer<std::byte> nodes_;
    Buffer<uint> arrivals_;  ///< one a meeting of two children, zero before and after a build
};

/// Boxes that are stored one behind the other.
std::vector<Aabb> read_boxes(std::span<const std::byte> stored, const BoxRounding& rounding);

using MakeRadixHierarchy = std::unique_ptr<RadixHierarchy> (*)(const RadixSetup& setup);

/// A builder around one way of the hierarchy: leaf order before it, a tree after it.
std::unique_ptr<Builder> make_radix_builder(Programs& programs, const BuilderCard& card,
                                            MakeRadixHierarchy make, const BuildOptions& options);
template <class Hierarchy>
std::unique_ptr<Builder> make_radix_builder(Programs& programs, std::string_view name,
                                            std::string_view method, const BuildOptions& options)
{
    return make_radix_builder(
        programs, {name, method, BuilderCard::Runs::on_device},
        [](const RadixSetup& setup) -> std::unique_ptr<RadixHierarchy> {
            return std::make_unique<Hierarchy>(setup);
        },
        options);
}

}  // namespace bvhbench
