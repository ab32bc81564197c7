// SPDX-License-Identifier: MIT
#include "baselines/baselines.h"
#include "baselines/radix/hierarchy.h"

namespace bvhbench {
namespace {

class ApetreiFused final : public RadixHierarchy {
public:
    explicit ApetreiFused(const RadixSetup& setup)
        : launch_(setup.launch), build_(setup.kernel("baselines/radix/apetrei_fused.cl", "build"))
    {}

    void plan(Arena& arena, const RadixLeaves& leaves) override
    {
        leaves_ = &leaves;
        nodes_ = take_radix_nodes(arena, leaves);
        ends_ = arena.take<uint>(leaves.count - 1, Use::scratch);
    }

    void prepare(const cl::CommandQueue& queue) override
    {
        ends_.upload(queue, std::vector<uint>(ends_.size(), 0u));
    }

    void build(Queue& queue) override
    {
        set_arguments(build_, leaves_->codes, leaves_->boxes, leaves_->ids, nodes_, ends_,
                      leaves_->count);
        launch_(queue, build_, leaves_->count,
                leaves_->code_bytes() + leaves_->box_bytes() +
                    static_cast<std::int64_t>(nodes_.bytes()));
    }

    /// The codes are still there, and from them comes the same tree. No parents are stored that would tell sooner.
    void refit(Queue& queue) override { build(queue); }

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
    RadixLaunch launch_;
    cl::Kernel build_;
    const RadixLeaves* leaves_ = nullptr;
    Buffer<std::byte> nodes_;
    Buffer<uint> ends_;  ///< one a gap between leaves
};

}  // namespace

std::unique_ptr<Builder> make_apetrei_fused(Programs& programs, const BuildOptions& options)
{
    return make_radix_builder(
        programs,
        {"apetrei-fused", "Binary radix tree, one launch, one exchange a node [Apetrei2014]",
         BuilderCard::Runs::on_device},
        [](const RadixSetup& setup) -> std::unique_ptr<RadixHierarchy> {
            return std::make_unique<ApetreiFused>(setup);
        },
        options);
}

}  // namespace bvhbench
