// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh.h"

namespace bvhbench {

/// Two triangles by their frame-wide ids: position in Scene::faces, through all objects. 8 bytes.
struct Pair {
    uint a = 0;
    uint b = 0;
    auto operator<=>(const Pair&) const = default;
};

/// A set of pairs in canonical form: the smaller id first, each pair once, ascending.
///
/// Colliders find pairs in any order. Two colliders agree when their lists are equal, and lists are equal
/// when their hashes are, short of a collision in 64 bits.
class PairList {
public:
    PairList() = default;

    /// From pairs in any order, either id first.
    explicit PairList(std::vector<Pair> found);

    std::span<const Pair> pairs() const { return pairs_; }
    std::size_t size() const { return pairs_.size(); }

    /// How many of the pairs found are not in the list: found before, or a triangle with itself. A collider
    /// that keeps its promise has none.
    std::size_t surplus() const { return surplus_; }

    /// FNV-1a over the little-endian 32-bit ids, pair after pair: a format others can reproduce.
    std::uint64_t hash() const;

    bool operator==(const PairList& other) const { return pairs_ == other.pairs_; }

private:
    std::vector<Pair> pairs_;
    std::size_t surplus_ = 0;
};

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
