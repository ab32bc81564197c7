// SPDX-License-Identifier: MIT
//
// Findings about trees, pairs and systems that find pairs. A variant is an equivalent scene: a system must find the same in the
// variant as in the scene, which needs no reference.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "builders/tree.h"
#include "collide/pairs.h"
#include "harness/record/finding.h"
#include "scenes/stress/stress_scene.h"

namespace bvhbench {

/// Pairs and contacts that a system found; a list that it does not compute has no value.
struct FoundPairs {
    std::optional<PairList> pairs, contacts;
    bool is_rounded = false;  ///< boxes were rounded outward
    bool operator==(const FoundPairs&) const = default;
};

/// Runs such a system over a scene. Its buffers have room for `capacity` entries at first; 0 means the usual number.
using PairFinder = std::function<FoundPairs(const StressScene& scene, std::size_t capacity)>;

/// A scene made of triangles of another scene.
struct Rearranged {
    StressScene scene;
    std::vector<uint> original;  ///< number of each triangle in the other scene; empty: the same
};

struct StressVariant {
    Invariant of;  ///< agree or moved
    std::string_view name;
    Rearranged moved;
    FoundPairs expected;  ///< in the triangle numbers of the original scene
};

/// A scene, its variants, and the correct answer for each.
struct StressQuestion {
    StressScene scene;
    FoundPairs expected;
    std::vector<StressVariant> variants;
};

/// Returns the scene with every coordinate multiplied by a power of two, exactly, or nothing if no power keeps all bits. The
/// power is between 2^-30 and 2^30 and depends on the seed.
std::optional<StressScene> scaled(const StressScene& scene, std::uint64_t seed);

/// Returns the scene without the bits that have no room after a move by one power of two, and that scene moved, exactly; nothing
/// if the move is impossible.
std::optional<std::pair<StressScene, StressScene>> translated(const StressScene& scene);

/// Returns the triangles whose vertices are finite.
Rearranged finite_part(const StressScene& scene);

/// Returns the question with the answers of the sweep and, if built in, the exact predicates. Pairs that share a vertex are
/// included. Variants: triangles shuffled within each object, objects in reverse order, scaled() and translated().
StressQuestion question_of(StressScene scene, std::uint64_t seed);

/// Returns the question without pairs that share a vertex, for systems that cannot report them.
StressQuestion without_adjacent(StressQuestion question);

/// Judges the leaves and boxes of a tree.
Findings judge_tree(const HostTree& tree, std::span<const Point> points,
                    std::span<const Face> faces);

/// Counts missed, false and repeated pairs. With `may_add` false pairs are allowed, as for boxes that were rounded outward.
Finding judge_pairs(const PairList& found, const PairList& expected, bool may_add = false);

/// Judges `repeats` more runs of a task. `run` runs it and returns whether it left the same as the first run.
Finding judge_repeats(int repeats, const std::function<bool()>& run);

/// Runs the system over the scene, its variants and with room for one entry. Throws what the system throws.
Findings judge_finder(const PairFinder& finder, const StressQuestion& question);

}  // namespace bvhbench
