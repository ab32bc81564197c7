// SPDX-License-Identifier: MIT
#include "baselines/baselines.h"
#include "baselines/radix/hierarchy.h"

namespace bvhbench {
namespace {

class Karras final : public RadixHierarchy {
public:
    explicit Karras(const RadixSetup& setup)
        : launch_(setup.launch)
        , topology_(setup.kernel("baselines/radix/karras_topology.cl", "topology"))
        , boxes_(setup.kernel("baselines/radix/karras_boxes.cl", "boxes"))
    {}

    void plan(Arena& arena, const RadixLeaves& leaves) override
    {
        leaves_ = &leaves;
        const std::size_t inner = leaves.count - 1;
        nodes_ = take_radix_nodes(arena, leaves);
        parents_ = arena.take<uint>(inner + leaves.count, Use::scratch);
        arrivals_ = arena.take<uint>(inner, Use::scratch);
    }

    void prepare(const cl::CommandQueue& queue) override
    {
        arrivals_.upload(queue, std::vector<uint>(arrivals_.size(), 0u));
    }

    void build(Queue& queue) override
    {
        set_arguments(topology_, leaves_->codes, nodes_, parents_, leaves_->count);
        launch_(queue, topology_, leaves_->count - 1,
                leaves_->code_bytes() + node_bytes() + parent_bytes());
        make_boxes(queue);
    }

    void refit(Queue& queue) override { make_boxes(queue); }

    std::vector<RadixNode> download(const cl::CommandQueue& queue, const BoxRounding& rounding,
                                    uint& root) const override
    {
        root = 0;
        return read_radix_nodes(nodes_.download(queue), rounding);
    }

    cl_uint bind(cl::Kernel& kernel, cl_uint first) const override
    {
        return set_arguments_from(kernel, first, nodes_);
    }

private:
    std::int64_t node_bytes() const { return static_cast<std::int64_t>(nodes_.bytes()); }
    std::int64_t parent_bytes() const { return static_cast<std::int64_t>(parents_.bytes()); }

    /// Children are read and boxes written; they share their sectors.
    void make_boxes(Queue& queue)
    {
        set_arguments(boxes_, leaves_->boxes, leaves_->ids, nodes_, parents_, arrivals_,
                      leaves_->count);
        const auto children = static_cast<std::int64_t>(leaves_->inner() * 2 * sizeof(uint));
        launch_(queue, boxes_, leaves_->count,
                leaves_->box_bytes() + parent_bytes() + children + node_bytes());
    }

    RadixLaunch launch_;
    cl::Kernel topology_, boxes_;
    const RadixLeaves* leaves_ = nullptr;
    Buffer<std::byte> nodes_;
    Buffer<uint> parents_;   ///< inner nodes, then leaves
    Buffer<uint> arrivals_;  ///< one an inner node
};

}  // namespace

std::unique_ptr<Builder> make_karras(Programs& programs, const BuildOptions& options)
{
    return make_radix_builder(
        programs,
        {"karras", "Binary radix tree, topology and then boxes [Karras2012]",
         BuilderCard::Runs::on_device},
        [](const RadixSetup& setup) -> std::unique_ptr<RadixHierarchy> {
            return std::make_unique<Karras>(setup);
        },
        options);
}

}  // namespace bvhbench
