// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "collide/set_hash.h"
#include "geometry/mesh.h"

namespace bvhbench {

/// Two triangles by frame-wide ids, that is positions in Scene::faces across all objects. 8 bytes.
struct Pair {
    uint a = 0;
    uint b = 0;
    auto operator<=>(const Pair&) const = default;
};

/// A set of pairs in canonical form: smaller id first, each pair once, ascending.
///
/// Colliders find pairs in any order. Two colliders agree if and only if their lists are equal. Equal hashes imply equal lists,
/// short of a collision in 64 bits.
class PairList {
public:
    PairList() = default;

    /// Takes pairs in any order, with either id first. Sorts them on all host cores.
    explicit PairList(std::vector<Pair> found);

    std::span<const Pair> pairs() const { return pairs_; }
    std::size_t size() const { return pairs_.size(); }

    /// Number of input pairs that are not in the list: duplicates, or a triangle with itself. A correct collider has none.
    std::size_t surplus() const { return surplus_; }

    /// FNV-1a over the little-endian 32-bit ids, pair after pair, so that other programs can reproduce it.
    std::uint64_t hash() const;

    bool operator==(const PairList& other) const { return pairs_ == other.pairs_; }

private:
    std::vector<Pair> pairs_;
    std::size_t surplus_ = 0;
};

/// What identifies a set of pairs without listing it: two lists of pairs with equal facts have the same pairs, in whatever order,
/// as often, short of a collision in 128 bits.
struct PairFacts {
    std::uint64_t count = 0;
    std::uint64_t low = 0, high = 0;  ///< SetHash

    bool operator==(const PairFacts&) const = default;
};

/// Returns the facts of pairs in any order, with either id first. Uses all host cores.
PairFacts facts_of(std::span<const Pair> pairs);

/// Relation between the two triangles of a pair. Papers count different relations, so they are kept apart here.
enum class Relation {
    between_objects,  ///< two objects, even if a vertex is shared
    apart,            ///< one object, no shared vertex
    adjacent,         ///< one object, a shared vertex: the boxes always overlap
};

/// Triangles that pairs refer to.
struct Family {
    std::span<const Face> faces;
    std::span<const uint> objects;  ///< object of each face; empty if there is only one object
};

Relation relation_of(Pair pair, const Family& family);

/// Which pairs are wanted, by the objects of their triangles.
enum class Among { all, between_objects, within_objects };

/// True if `pair` is among the wanted ones; `objects` are the face ranges of all objects.
bool is_among(Pair pair, std::span<const FaceRange> objects, Among among);

/// Returns the pairs that `is_wanted` accepts.
PairList chosen(const PairList& pairs, const std::function<bool(Pair)>& is_wanted);

/// Returns the pairs that `is_among` accepts.
PairList among_objects(const PairList& pairs, std::span<const FaceRange> objects, Among among);

/// Returns the pairs with the given relation.
PairList selected(const PairList& pairs, const Family& family, Relation relation);

/// Returns the pairs with numbers[k] for triangle k. Empty `numbers`: with the same numbers.
PairList renumbered(PairList pairs, std::span<const uint> numbers);

}  // namespace bvhbench
