// SPDX-License-Identifier: MIT
//
// Checks of sets of pairs that are too large to list on the host.
#pragma once

#include <span>
#include <vector>

#include "collide/collider.h"
#include "collide/oracles/wanted_pairs.h"

namespace bvhbench {

/// Returns the facts of the `count` pairs in device memory. With `names`, triangle k is known as names[k]. Blocks.
PairFacts facts_on_device(Programs& programs, const DevicePairs& pairs, std::uint64_t count,
                          Queue& queue, const Buffer<uint>* names = nullptr);

/// A random sample of a frame's triangles, the same for the same number of triangles on every machine.
class TriangleSample {
public:
    /// Chooses `size` of `triangles` triangles, or all if they are fewer.
    TriangleSample(std::size_t triangles, std::size_t size);

    std::span<const uint> ids() const { return ids_; }

    /// Returns the pairs in device memory that have a triangle of the sample. With `names`, triangle k is known as names[k]. Blocks.
    std::vector<Pair> of_device(Programs& programs, const DevicePairs& pairs, std::uint64_t count,
                                Queue& queue, const Buffer<uint>* names = nullptr) const;

    /// Returns the right ones: compares the box of each triangle of the sample with every box, on all cores of the host.
    PairList by_brute_force(std::span<const Aabb> boxes, const WantedPairs& wanted) const;

    bool has(uint id) const { return (bits_[id / 32] >> id % 32 & 1u) != 0; }

private:
    std::vector<uint> ids_;   ///< ascending
    std::vector<uint> bits_;  ///< one per triangle, set if it is in the sample
};

}  // namespace bvhbench
