// SPDX-License-Identifier: MIT
#include "baselines/baselines.h"
#include "baselines/radix/hierarchy.h"

namespace bvhbench {
namespace {

/// As printed: boxes, children and ranges in arrays, by split, as are all nodes but the root. `nodes_` has boxes only.
class Apetrei final : public RadixHierarchy {
public:
    explicit Apetrei(const RadixSetup& setup)
        : RadixHierarchy(setup)
        , deltas_(setup.kernel("baselines/radix/apetrei.cl", "deltas"))
        , build_(setup.kernel("baselines/radix/apetrei.cl", "build"))
    {}

    void plan(Arena& arena) override
    {
        const std::size_t inner = leaves_.inner();
        nodes_ = arena.take<std::byte>(inner * leaves_.format->box_bytes(), Use::tree);
        children_ = arena.take<uint>(2 * inner, Use::tree);
        root_ = arena.take<uint>(1, Use::tree);
        ranges_ = arena.take<uint>(2 * inner, Use::scratch);
        common_ = arena.take<uint>(inner, Use::scratch);
        arrivals_ = arena.take<uint>(inner, Use::scratch);
    }

    void prepare(const cl::CommandQueue& queue) override
    {
        RadixHierarchy::prepare(queue);
        root_.upload(queue, std::vector<uint>{0});
    }

    void build(Queue& queue) override
    {
        set_arguments(deltas_, leaves_.codes, common_, leaves_.count);
        launch_(queue, deltas_, leaves_.count - 1, leaves_.codes.bytes() + common_.bytes());
        refit(queue);
    }

    bool numbers_by_range() const override { return false; }

    /// The kernel finds the same tree again while it climbs; what leaves have in common has not changed.
    void refit(Queue& queue) override
    {
        set_arguments(build_, common_, leaves_.boxes, leaves_.ids, children_, ranges_, nodes_,
                      arrivals_, root_, leaves_.count);
        launch_(queue, build_, leaves_.count,
                common_.bytes() + leaves_.box_bytes() + children_.bytes() + ranges_.bytes() +
                    nodes_.bytes());
    }

    std::vector<RadixNode> download(const cl::CommandQueue& queue, const BoxRounding& rounding,
                                    uint& root) const override
    {
        root = root_.download(queue).at(0);
        const std::vector<Aabb> boxes = read_boxes(nodes_.download(queue), rounding);
        const std::vector<uint> children = children_.download(queue);
        std::vector<RadixNode> nodes;
        for (std::size_t k = 0; k < boxes.size(); ++k)
            nodes.push_back(radix_node(boxes[k], children[2 * k], children[2 * k + 1]));
        return nodes;
    }

    std::string_view access_header() const override { return "baselines/radix/access_apetrei.clh"; }

    cl_uint bind(cl::Kernel& kernel, cl_uint first) const override
    {
        return set_arguments_from(kernel, first, nodes_, children_, root_);
    }

private:
    cl::Kernel deltas_, build_;
    Buffer<uint> children_;  ///< left, right
    Buffer<uint> ranges_;    ///< first, last
    Buffer<uint> common_;    ///< one a gap between leaves
    Buffer<uint> root_;      ///< one: where the root is
};

/// In one launch. `arrivals_` holds the end of a range for each gap between leaves.
class ApetreiFused final : public RadixHierarchy {
public:
    explicit ApetreiFused(const RadixSetup& setup)
        : RadixHierarchy(setup), build_(setup.kernel("baselines/radix/apetrei_fused.cl", "build"))
    {}

    void plan(Arena& arena) override
    {
        nodes_ = take_nodes(arena);
        arrivals_ = arena.take<uint>(leaves_.inner(), Use::scratch);
    }

    void build(Queue& queue) override
    {
        set_arguments(build_, leaves_.codes, leaves_.boxes, leaves_.ids, nodes_, arrivals_,
                      leaves_.count);
        launch_(queue, build_, leaves_.count,
                leaves_.codes.bytes() + leaves_.box_bytes() + nodes_.bytes());
    }

    /// The codes are still there, and from them comes the same tree. No parents are stored that would tell sooner.
    void refit(Queue& queue) override { build(queue); }

private:
    cl::Kernel build_;
};

}  // namespace

std::unique_ptr<Builder> make_apetrei(Programs& programs, const BuildOptions& options)
{
    return make_radix_builder<Apetrei>(programs, "apetrei",
                                       "Binary radix tree, as printed [Apetrei2014]", options);
}

std::unique_ptr<Builder> make_apetrei_fused(Programs& programs, const BuildOptions& options)
{
    return make_radix_builder<ApetreiFused>(
        programs, "apetrei-fused",
        "Binary radix tree, one launch, one exchange a node [Apetrei2014]", options);
}

}  // namespace bvhbench
