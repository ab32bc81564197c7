// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "builders/tree.h"
#include "geometry/mesh.h"

namespace bvhbench {

/// Hash of a spelled-out tree: every box, child and primitive in depth-first order, bit for bit. Two trees
/// with the same hash are the same tree, wherever they keep their nodes.
std::uint64_t tree_hash(const HostTree& tree);

/// A tree of exact boxes, the only one of its scene, as a builder leaves it that keeps them in `format`. Rounding keeps the
/// order of sides, so that inner boxes may be rounded like leaves': they are the same unions.
HostTree rounded_to(HostTree tree, const BoxFormat& format);

/// The same tree with boxes over moved points, from the leaves up, slowly: the oracle of every refit. Boxes are rounded
/// as they were, into the cells of the scene as it is now.
HostTree refitted(HostTree tree, std::span<const Point> points, std::span<const Face> faces);

/// A promise that a tree breaks, and how, as a sentence.
struct Breach {
    enum class Of { nothing, leaves, boxes } of = Of::nothing;  ///< of its leaves: or of its nodes
    std::string sentence;
};

/// The first promise of every builder that `tree` breaks over these triangles; of nothing if it keeps them.
///
/// Each triangle is in exactly one leaf, each leaf's box is its triangle's box, as the tree rounds it, each inner node's box is the
/// union of its children's, bit for bit, or contains them where the tree does not say that it is tight; every node is
/// reached once from the root.
Breach first_breach(const HostTree& tree, std::span<const Point> points,
                    std::span<const Face> faces);

/// Its sentence, empty if there is none.
std::string broken_promise(const HostTree& tree, std::span<const Point> points,
                           std::span<const Face> faces);

}  // namespace bvhbench
