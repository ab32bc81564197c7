// SPDX-License-Identifier: MIT
//
// Findings about answers, whoever gave them: trees, pairs, and whoever finds pairs.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "builders/tree.h"
#include "collide/pairs.h"
#include "harness/record/finding.h"
#include "harness/stress/variants.h"

namespace bvhbench {

/// Leaves and boxes of a tree.
Findings judge_tree(const HostTree& tree, std::span<const Point> points,
                    std::span<const Face> faces);

/// Of a set of pairs: how many are missed, false, or found twice.
Finding judge_pairs(const PairList& found, const PairList& expected);

/// The same of pairs of boxes that were rounded outward: others may be among them.
Finding judge_candidates(const PairList& found, const PairList& expected);

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

/// With what the sweep and the exact predicates say, the latter where the program has them. Pairs that share a vertex
/// are among them.
StressQuestion question_of(StressScene scene, std::uint64_t seed);

/// The same without pairs that share a vertex, for systems that do not tell them.
StressQuestion without_adjacent(const StressQuestion& question);

/// Put the question. Throws what the system throws; `repeats` more runs than the others need must find the same.
Findings judge_finder(const PairFinder& finder, const StressQuestion& question, int repeats);

}  // namespace bvhbench
