// SPDX-License-Identifier: MIT
#include "cluster/pair_test.h"

namespace bvhbench {

PairDecider::PairDecider(Programs& programs, const PairTest& test)
{
    if (test.distance)
        within_.emplace(programs, WithinOptions{.distance = *test.distance,
                                                .method = test.narrow,
                                                .keep_adjacent = test.keep_adjacent});
    else
        meet_.emplace(programs,
                      NarrowOptions{.method = test.narrow, .keep_adjacent = test.keep_adjacent});
}

void PairDecider::reserve(std::size_t points, std::size_t triangles)
{
    if (within_)
        within_->reserve(points, triangles);
    else
        meet_->reserve(triangles);
}

std::optional<Input> PairDecider::padded(const Input& input, Queue& queue)
{
    return within_ ? std::optional(within_->padded(input, queue)) : std::nullopt;
}

void PairDecider::decide(const Input& input, const DevicePairs& candidates, Queue& queue)
{
    if (meet_) {
        find_contacts(*meet_, input, candidates.pairs, candidates.counters, queue);
        return;
    }
    do
        within_->query(input, candidates, queue);
    while (!within_->complete(queue));
}

std::vector<Pair> PairDecider::pairs(const Queue& queue) const
{
    return within_ ? within_->pairs(queue) : meet_->contacts(queue);
}

std::uint64_t PairDecider::count(const Queue& queue) const
{
    return within_ ? within_->counts(queue).within : meet_->counts(queue).contacts;
}

}  // namespace bvhbench
