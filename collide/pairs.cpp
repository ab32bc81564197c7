// SPDX-License-Identifier: MIT
#include "collide/pairs.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "geometry/hash.h"

namespace bvhbench {

// The hash reads the list's own bytes.
static_assert(std::endian::native == std::endian::little && sizeof(Pair) == 8);

PairList::PairList(std::vector<Pair> found) : pairs_(std::move(found))
{
    const std::size_t found_count = pairs_.size();
    std::erase_if(pairs_, [](Pair pair) { return pair.a == pair.b; });
    for (Pair& pair : pairs_)
        if (pair.b < pair.a)
            std::swap(pair.a, pair.b);
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    surplus_ = found_count - pairs_.size();
}

std::uint64_t PairList::hash() const
{
    Hash hash;
    hash.values(pairs());
    return hash.get();
}

}  // namespace bvhbench
