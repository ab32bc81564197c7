// SPDX-License-Identifier: MIT
#include "baselines/baselines.h"
#include "baselines/host/top_down.h"

namespace bvhbench {
namespace {

/// Half of the triangles left, half right, along the longest axis of their centres.
struct MedianSplit {
    static constexpr BuilderCard card = {
        "median-split", "object median on the longest axis, on one core of the host",
        BuilderCard::Runs::on_host};

    std::size_t operator()(std::span<uint> ids, std::span<const Aabb>,
                           std::span<const Centre> centres) const
    {
        split_at(ids, centres, ids.size() / 2);
        return ids.size() / 2;
    }
};

}  // namespace

std::unique_ptr<Builder> make_median_split(Programs&, const BuildOptions&)
{
    return make_host_builder(std::make_unique<TopDown<MedianSplit>>());
}

}  // namespace bvhbench
