// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "collide/pairs.h"
#include "geometry/mesh.h"

namespace bvhbench {

/// What the two triangles of a pair are to each other. Papers count different ones, so ours are told apart.
enum class Relation {
    between_objects,  ///< of two objects, even if they share a vertex
    apart,            ///< of one object, no vertex shared
    adjacent,         ///< of one object, with a shared vertex: their boxes always overlap
};

/// The triangles that pairs speak of.
struct Family {
    std::span<const Face> faces;
    std::span<const uint> objects;  ///< object of each face; empty if there is one object only
};

Relation relation_of(Pair pair, const Family& family);

/// Which pairs are looked for, by the objects their triangles are of.
enum class Among { all, between_objects, within_objects };

/// Whether a pair is one of those, of triangles of these objects.
bool is_among(Pair pair, std::span<const FaceRange> objects, Among among);

/// The pairs among those objects.
PairList among_objects(const PairList& pairs, std::span<const FaceRange> objects, Among among);

/// The pairs of one relation.
PairList selected(const PairList& pairs, const Family& family, Relation relation);

}  // namespace bvhbench
