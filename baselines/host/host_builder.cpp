// SPDX-License-Identifier: MIT
#include "baselines/host/host_builder.h"

#include <vector>

namespace bvhbench {
namespace {

class HostBuilder final : public Builder {
public:
    explicit HostBuilder(std::unique_ptr<HostMethod> method) : method_(std::move(method)) {}

    BuilderCard card() const override { return method_->card(); }

    Footprint footprint(std::size_t primitives) const override
    {
        Footprint footprint = method_->footprint(primitives);
        footprint.scratch_bytes += primitives * sizeof(Aabb);
        return footprint;
    }

    void reserve(std::size_t primitives) override
    {
        boxes_.resize(primitives);
        method_->reserve(primitives);
        reserved_ = footprint(primitives);
    }

    Footprint reserved() const override { return reserved_; }

    const Tree& build(const Input& input, Queue& queue, Start start) override
    {
        if (start == Start::from_triangles)
            queue.on_host("bounds", [&] {
                for (std::size_t k = 0; k < boxes_.size(); ++k)
                    boxes_[k] = leaf_box(input, input.faces[k]);
            });
        method_->accept(boxes_);
        queue.on_host("hierarchy", [&] { method_->build(); });
        return method_->tree();
    }

private:
    std::unique_ptr<HostMethod> method_;
    std::vector<Aabb> boxes_;
    Footprint reserved_;
};

}  // namespace

std::unique_ptr<Builder> make_host_builder(std::unique_ptr<HostMethod> method)
{
    return std::make_unique<HostBuilder>(std::move(method));
}

}  // namespace bvhbench
