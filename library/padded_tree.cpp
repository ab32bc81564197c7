// SPDX-License-Identifier: MIT
#include "builders/implicit/tree.h"
#include "library/tree.h"

namespace bvhbench::oibvh {

bvhbench::Input PaddedTree::build(double distance, const bvhbench::Input& input,
                                  const std::vector<uint>& sizes)
{
    if (!phase_)
        phase_.emplace(device_.programs, WithinOptions{.distance = distance,
                                                       .keep_adjacent = options_.adjacent_pairs});
    phase_->set_distance(distance);
    const std::size_t points = input.device_points.size();
    if (builder_ == nullptr) {
        auto builder = make_builder(device_, options_);
        builder->reserve_objects(sizes);
        builder_ = std::move(builder);
    }
    if (std::exchange(points_, 0) != points)  // set again on success
        phase_->reserve(points, input.triangle_count());
    points_ = points;
    bvhbench::Input padded = phase_->padded(input, device_.queue);
    tree_ = &dynamic_cast<const ImplicitTree&>(builder_->build(padded, device_.queue));
    return padded;
}

std::pair<DevicePairs, std::uint64_t> PaddedTree::decide(const bvhbench::Input& input,
                                                         const DevicePairs& candidates)
{
    do
        phase_->query(input, candidates, device_.queue);
    while (!phase_->complete(device_.queue));
    return {phase_->device_pairs(), phase_->counts(device_.queue).within};
}

std::size_t PaddedTree::memory() const
{
    return (builder_ ? builder_->reserved().total() : 0) +
           (phase_ ? phase_->reserved().total() : 0);
}

void PaddedTree::free()
{
    builder_.reset();
    phase_.reset();
    points_ = 0;
}

}  // namespace bvhbench::oibvh
