// SPDX-License-Identifier: MIT
#include "baselines/baselines.h"
#include "baselines/radix/hierarchy.h"

namespace bvhbench {
namespace {

class Apetrei final : public RadixHierarchy {
public:
    explicit Apetrei(const RadixSetup& setup)
        : launch_(setup.launch)
        , deltas_(setup.kernel("baselines/radix/apetrei_deltas.cl", "deltas"))
        , build_(setup.kernel("baselines/radix/apetrei.cl", "build"))
    {}

    void plan(Arena& arena, const RadixLeaves& leaves) override
    {
        leaves_ = &leaves;
        const std::size_t inner = leaves.count - 1;
        boxes_ = arena.take<std::byte>(inner * leaves.format->box_bytes(), Use::tree);
        children_ = arena.take<uint>(2 * inner, Use::tree);
        root_ = arena.take<uint>(1, Use::tree);
        ranges_ = arena.take<uint>(2 * inner, Use::scratch);
        common_ = arena.take<uint>(inner, Use::scratch);
        arrivals_ = arena.take<uint>(inner, Use::scratch);
    }

    void prepare(const cl::CommandQueue& queue) override
    {
        arrivals_.upload(queue, std::vector<uint>(arrivals_.size(), 0u));
        root_.upload(queue, std::vector<uint>{0});
    }

    void build(Queue& queue) override
    {
        set_arguments(deltas_, leaves_->codes, common_, leaves_->count);
        launch_(queue, deltas_, leaves_->count - 1, leaves_->code_bytes() + bytes_of(common_));
        climb(queue);
    }

    bool numbers_by_range() const override { return false; }

    /// The kernel finds the same tree again while it climbs; what leaves have in common has not changed.
    void refit(Queue& queue) override { climb(queue); }

    std::vector<RadixNode> download(const cl::CommandQueue& queue, const BoxRounding& rounding,
                                    uint& root) const override
    {
        root = root_.download(queue).at(0);
        const std::vector<Aabb> boxes = read_boxes(boxes_.download(queue), rounding);
        const std::vector<uint> children = children_.download(queue);
        std::vector<RadixNode> nodes;
        for (std::size_t k = 0; k < boxes.size(); ++k)
            nodes.push_back(radix_node(boxes[k], children[2 * k], children[2 * k + 1]));
        return nodes;
    }

    std::string_view access_header() const override { return "baselines/radix/access_apetrei.clh"; }

    cl_uint bind(cl::Kernel& kernel, cl_uint first) const override
    {
        return set_arguments_from(kernel, first, boxes_, children_, root_);
    }

private:
    template <class T>
    static std::int64_t bytes_of(const Buffer<T>& buffer)
    {
        return static_cast<std::int64_t>(buffer.bytes());
    }

    void climb(Queue& queue)
    {
        set_arguments(build_, common_, leaves_->boxes, leaves_->ids, children_, ranges_, boxes_,
                      arrivals_, root_, leaves_->count);
        launch_(queue, build_, leaves_->count,
                bytes_of(common_) + leaves_->box_bytes() + bytes_of(children_) + bytes_of(ranges_) +
                    bytes_of(boxes_));
    }

    RadixLaunch launch_;
    cl::Kernel deltas_, build_;
    const RadixLeaves* leaves_ = nullptr;
    Buffer<std::byte> boxes_;  ///< by split, as are all but the root
    Buffer<uint> children_;    ///< left, right
    Buffer<uint> ranges_;      ///< first, last
    Buffer<uint> common_;      ///< one a gap between leaves
    Buffer<uint> arrivals_;
    Buffer<uint> root_;  ///< one: where the root is
};

}  // namespace

std::unique_ptr<Builder> make_apetrei(Programs& programs, const BuildOptions& options)
{
    return make_radix_builder(
        programs,
        {"apetrei", "Binary radix tree, as printed [Apetrei2014]", BuilderCard::Runs::on_device},
        [](const RadixSetup& setup) -> std::unique_ptr<RadixHierarchy> {
            return std::make_unique<Apetrei>(setup);
        },
        options);
}

}  // namespace bvhbench
