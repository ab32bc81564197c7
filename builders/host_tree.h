// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "builders/tree.h"
#include "geometry/mesh.h"

namespace bvhbench {

/// Returns a hash of every box, child and primitive in depth-first order, bit for bit. Trees with equal hashes are the same
/// tree, whatever their memory layout.
std::uint64_t tree_hash(const HostTree& tree);

/// Returns `tree`, which has exact boxes and is the only tree of its scene, as a builder with boxes in `format` makes it.
/// Rounding is monotonic, so rounding an inner box gives the union of its rounded children.
HostTree rounded_to(HostTree tree, const BoxFormat& format);

/// Returns `tree` with boxes recomputed over moved points from the leaves up: the oracle of every refit. Boxes are rounded to
/// the tree's format, in the cells of the moved scene.
HostTree refitted(HostTree tree, std::span<const Point> points, std::span<const Face> faces);

/// An invariant that a tree violates, described in a sentence.
struct Violation {
    enum class Of { nothing, leaves, boxes } of = Of::nothing;  ///< `leaves` includes topology.
    std::string sentence;
};

/// Returns the first invariant of all builders that `tree` violates over these triangles; `Of::nothing` if there is none.
///
/// The invariants: each triangle is in exactly one leaf; each leaf's box is its triangle's box, rounded as the tree rounds, and
/// contains it; each inner node's box is the union of its children's boxes, bit for bit; every node is reached exactly once
/// from the root. If boxes may be larger, a box need only contain its triangle's or its children's.
Violation first_violation(const HostTree& tree, std::span<const Point> points,
                          std::span<const Face> faces);

/// Returns the sentence of first_violation; empty if no invariant is violated.
std::string invariant_violation(const HostTree& tree, std::span<const Point> points,
                                std::span<const Face> faces);

}  // namespace bvhbench
