// SPDX-License-Identifier: MIT
//
// What processes of a sweep do: one cell each, or all of a scene.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "harness/sweep/plan.h"

namespace bvhbench {

/// What one process measures. It is there in full or not at all, so it is what an interruption costs.
struct SweepUnit {
    std::vector<SweepCell> cells;
    Json experiment;         ///< what the process runs
    std::uint64_t what = 0;  ///< hash of all that is measured, and how
    std::int64_t triangles = 0;
    std::string label;  ///< for people: scene, builder or pipeline
};

/// The sweep's cells as units, in its order; those that cannot be are not among them. `together`: all builds, and all
/// pipelines, of a scene in one process, so that their samples are interleaved. `settings` is what else decides what is
/// measured, the options of the program.
std::vector<SweepUnit> units_of(const Sweep& sweep, bool together, const std::string& settings);

/// One of the sweep's parts for machines that work side by side.
struct Shard {
    unsigned number = 1, of = 1;
    bool is_all() const { return of == 1; }
};

/// "2/8": the second of eight. Throws BadUsage.
Shard shard_called(const std::string& text);

/// Which shard each unit is in, from 1: the same wherever it is asked. Shards have about as many triangles each; what a
/// process costs besides is counted as triangles too.
std::vector<unsigned> shards_of(const std::vector<SweepUnit>& units, unsigned shards);

/// The cell as a result file tells it before anything is known of it.
Cell record_of(const Sweep& sweep, const SweepCell& cell);

}  // namespace bvhbench
