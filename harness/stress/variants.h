// SPDX-License-Identifier: MIT
//
// A scene in other words: what is found over it must be what was found before, and no reference is needed to know.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

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

/// Objects stay in their order, triangles of each are shuffled.
StressVariant shuffled(const StressScene& scene, std::uint64_t seed);

/// The last object first. Of one object nothing.
std::optional<StressVariant> swapped(const StressScene& scene);

/// Every coordinate times a power of two, exactly; nothing if there is none that leaves all bits there. From 2^-30 to
/// 2^30, which one depends on the seed.
std::optional<StressVariant> scaled(const StressScene& scene, std::uint64_t seed);

/// Every coordinate moved by some power of two, exactly, after `snap` has taken off the bits that have no room there;
/// nothing where that leaves one place of all.
struct Translation {
    StressScene snapped;
    StressVariant moved;
};
std::optional<Translation> translated(const StressScene& scene);

/// Pairs by the numbers that triangles have in the scene that a variant is of.
PairList in_original_numbers(const PairList& pairs, const StressVariant& variant);

}  // namespace bvhbench
