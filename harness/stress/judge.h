// SPDX-License-Identifier: MIT
//
// Findings about answers, whoever gave them: trees, pairs, and systems that find pairs. A variant is a scene in other words:
// what is found over it must be what was found before, and no reference is needed to know.
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
    std::vector<uint> original =
        {};  ///< by this scene's triangle, the other one's; empty: the same
};

/// Every coordinate times a power of two, exactly; nothing if there is none that leaves all bits there. From 2^-30 to
/// 2^30, which one depends on the seed.
std::optional<StressVariant> scaled(const StressScene& scene, std::uint64_t seed);

/// Every coordinate moved by some power of two, exactly, after the bits that have no room there are taken off in `snapped`;
/// nothing where that leaves one place of all.
struct Translation {
    StressScene snapped;
    StressVariant moved;
};
std::optional<Translation> translated(const StressScene& scene);

/// Pairs by the numbers that triangles have in the scene that a variant is of.
PairList in_original_numbers(const PairList& pairs, const StressVariant& variant);

/// Leaves and boxes of a tree.
Findings judge_tree(const HostTree& tree, std::span<const Point> points,
                    std::span<const Face> faces);

/// Of a set of pairs: how many are missed, false, or found twice. False ones are allowed if `may_add`: of pairs of boxes that
/// were rounded outward.
Finding judge_pairs(const PairList& found, const PairList& expected, bool may_add = false);

/// Of the same thing done so often: hashes that are not the first one.
Finding judge_repeats(std::span<const std::uint64_t> hashes);

/// What a system that looks for pairs has found; what it does not look for is not there.
struct FoundPairs {
    std::optional<PairList> pairs, contacts;
    bool is_rounded = false;  ///< pairs are of boxes that were rounded outward
    bool operator==(const FoundPairs&) const = default;
};

/// Of the sets of both.
std::uint64_t hash_of(const FoundPairs& found);

/// Such a system: over a scene, with buffers that begin with so many entries, 0 for as many as is usual.
using PairFinder = std::function<FoundPairs(const StressScene& scene, std::size_t capacity)>;

/// A scene, its variants, and what is to be found over each.
struct StressQuestion {
    struct Variant {
        StressVariant variant;
        FoundPairs expected;  ///< by the numbers of the variant's original
    };
    StressScene scene;
    FoundPairs expected;
    std::vector<Variant> variants;
};

/// What the sweep and the exact predicates say, the latter where the program has them. Pairs that share a vertex are among
/// them. The variants are triangles shuffled within each object, the objects in reverse order, scaled() and translated().
StressQuestion question_of(StressScene scene, std::uint64_t seed);

/// The same without pairs that share a vertex, for systems that do not tell them.
StressQuestion without_adjacent(const StressQuestion& question);

/// Put the question. Throws what the system throws.
Findings judge_finder(const PairFinder& finder, const StressQuestion& question);

}  // namespace bvhbench
