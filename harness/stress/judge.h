// SPDX-License-Identifier: MIT
//
// Findings about trees, pairs and systems that find pairs. A variant is an equivalent scene: a system must find the same in the
// variant as in the scene, which needs no reference.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "builders/tree.h"
#include "collide/pairs.h"
#include "harness/record/finding.h"
#include "scenes/stress/stress_scene.h"

namespace bvhbench {

struct StressVariant {
    Invariant of;  ///< agree or moved
    std::string_view name;
    StressScene scene;
    std::vector<uint> original = {};  ///< number in the original scene; empty: the same
};

/// Returns the scene with every coordinate multiplied by a power of two, exactly, or nothing if no power keeps all bits. The
/// power is between 2^-30 and 2^30 and depends on the seed.
std::optional<StressVariant> scaled(const StressScene& scene, std::uint64_t seed);

/// A scene with every coordinate moved by one power of two, exactly. `snapped` is the original without the bits that have no
/// room after the move. translated() returns nothing if the move is impossible.
struct Translation {
    StressScene snapped;
    StressVariant moved;
};
std::optional<Translation> translated(const StressScene& scene);

/// Returns the pairs with the triangle numbers of the variant's original scene.
PairList in_original_numbers(const PairList& pairs, const StressVariant& variant);

/// Judges the leaves and boxes of a tree.
Findings judge_tree(const HostTree& tree, std::span<const Point> points,
                    std::span<const Face> faces);

/// Counts missed, false and repeated pairs. With `may_add` false pairs are allowed, as for boxes that were rounded outward.
Finding judge_pairs(const PairList& found, const PairList& expected, bool may_add = false);

/// Judges repeated runs of one task: counts the hashes that differ from the first.
Finding judge_repeats(std::span<const std::uint64_t> hashes);

/// Pairs and contacts that a system found; a list that it does not compute has no value.
struct FoundPairs {
    std::optional<PairList> pairs, contacts;
    bool is_rounded = false;  ///< boxes were rounded outward
    bool operator==(const FoundPairs&) const = default;
};

/// Returns a hash of both lists.
std::uint64_t hash_of(const FoundPairs& found);

/// Runs such a system over a scene. Its buffers have room for `capacity` entries at first; 0 means the usual number.
using PairFinder = std::function<FoundPairs(const StressScene& scene, std::size_t capacity)>;

/// A scene, its variants, and the correct answer for each.
struct StressQuestion {
    struct Variant {
        StressVariant variant;
        FoundPairs expected;  ///< in the triangle numbers of the variant's original
    };
    StressScene scene;
    FoundPairs expected;
    std::vector<Variant> variants;
};

/// Returns the question with the answers of the sweep and, if built in, the exact predicates. Pairs that share a vertex are
/// included. Variants: triangles shuffled within each object, objects in reverse order, scaled() and translated().
StressQuestion question_of(StressScene scene, std::uint64_t seed);

/// Returns the question without pairs that share a vertex, for systems that cannot report them.
StressQuestion without_adjacent(const StressQuestion& question);

/// Runs the system over the scene, its variants and with room for one entry. Throws what the system throws.
Findings judge_finder(const PairFinder& finder, const StressQuestion& question);

}  // namespace bvhbench
