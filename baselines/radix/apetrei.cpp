// SPDX-License-Identifier: MIT
#include "baselines/baselines.h"
#include "baselines/radix/builder.h"

namespace bvhbench {
namespace {

/// [Apetrei2014] as printed: boxes, children and ranges in arrays, indexed by split.
class Apetrei final : public RadixBuilder {
public:
    Apetrei(Programs& programs, const BuildOptions& options)
        : RadixBuilder(programs, "apetrei", "Binary radix tree, as printed [Apetrei2014]",
                       make_apetrei, options)
        , deltas_(kernel("baselines/radix/apetrei.cl", "deltas"))
        , build_(kernel("baselines/radix/apetrei.cl", "build"))
    {
        tree_.in_arrays = tree_.root_is_stored = true;
        searches_roots_ = true;
    }

private:
    void plan_nodes(Arena& arena) override
    {
        tree_.nodes = take_nodes(arena);
        tree_.children = arena.take<uint>(2 * tree_.inner(), Use::tree);
        tree_.root = arena.take<uint>(1, Use::tree);
        ranges_ = arena.take<uint>(2 * tree_.inner(), Use::scratch);
        common_ = arena.take<uint>(tree_.inner(), Use::scratch);
        arrivals_ = arena.take<uint>(tree_.inner(), Use::scratch);
    }

    void prepare_nodes(const cl::CommandQueue& queue) override
    {
        RadixBuilder::prepare_nodes(queue);
        tree_.root.upload(queue, std::vector<uint>{0});
    }

    void build_nodes(Queue& queue) override
    {
        set_arguments(deltas_, tree_.codes, common_, tree_.leaves);
        launch(queue, deltas_, tree_.leaves - 1, tree_.codes.bytes() + common_.bytes());
        refit_nodes(queue);
    }

    /// Builds the whole tree again: `common_` has not changed, so the kernel finds the same topology while it climbs.
    void refit_nodes(Queue& queue) override
    {
        set_arguments(build_, common_, tree_.leaf_boxes, tree_.ids, tree_.children, ranges_,
                      tree_.nodes, arrivals_, tree_.root, tree_.leaves);
        launch(queue, build_, tree_.leaves,
               common_.bytes() + box_bytes() + tree_.children.bytes() + ranges_.bytes() +
                   tree_.nodes.bytes());
    }

    cl::Kernel deltas_, build_;
    Buffer<uint> ranges_;  ///< first and last leaf of each inner node
    Buffer<uint> common_;  ///< one entry per gap between leaves
};

/// [Apetrei2014] in one launch. `arrivals_` holds an end of a range for each gap between leaves. On devices with many lanes a group
/// merges its own leaves in local memory first (radix.local).
class ApetreiFused final : public RadixBuilder {
public:
    ApetreiFused(Programs& programs, const BuildOptions& options)
        : RadixBuilder(programs, "apetrei-fused",
                       "Binary radix tree, one launch, one exchange a node [Apetrei2014]",
                       make_apetrei_fused, options)
    {
        constexpr std::string_view path = "baselines/radix/apetrei_fused.cl";
        if (most_items_ == 0 && programs.device().tuned(radix_local) != 0 && fits_in_local_memory())
            build_ = kernel(path, "build", {{"GROUP_SIZE", static_cast<uint>(group_size_)}});
        else
            build_ = kernel(path, "build");
    }

private:
    /// True if a box and two words per leaf of a group fit, with 1 KiB for what compilers add.
    bool fits_in_local_memory() const
    {
        return group_size_ * (format().box_bytes() + 2 * sizeof(uint)) + 1024 <=
               programs_.device().cl.getInfo<CL_DEVICE_LOCAL_MEM_SIZE>();
    }

    void plan_nodes(Arena& arena) override
    {
        tree_.nodes = take_nodes(arena);
        arrivals_ = arena.take<uint>(tree_.inner(), Use::scratch);
    }

    void build_nodes(Queue& queue) override
    {
        set_arguments(build_, tree_.codes, tree_.leaf_boxes, tree_.ids, tree_.nodes, arrivals_,
                      tree_.leaves);
        launch(queue, build_, tree_.leaves,
               tree_.codes.bytes() + box_bytes() + tree_.nodes.bytes());
    }

    /// Builds the whole tree again from the same codes: no parents are stored that a faster refit could follow.
    void refit_nodes(Queue& queue) override { build_nodes(queue); }

    cl::Kernel build_;
};

}  // namespace

std::unique_ptr<Builder> make_apetrei(Programs& programs, const BuildOptions& options)
{
    return std::make_unique<Apetrei>(programs, options);
}

std::unique_ptr<Builder> make_apetrei_fused(Programs& programs, const BuildOptions& options)
{
    return std::make_unique<ApetreiFused>(programs, options);
}

}  // namespace bvhbench
