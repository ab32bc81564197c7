// SPDX-License-Identifier: MIT
//
// The experiment `smoke` held to what it found before: all that no machine changes exactly, and times as ratios.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/record.h"

namespace bvhbench {

/// What is kept of a cell.
struct SmokeCell {
    std::string name;                           ///< cell_label
    std::string scene;                          ///< cells of one are held against each other
    std::string verdict;                        ///< verdict_text
    std::map<std::string, double> counters;     ///< those of machine_independent_counters
    std::map<std::string, std::string> hashes;  ///< of tree, pairs and contacts; 16 digits
    double fastest_ns = 0;  ///< of all stages; 0: has no time that may be compared

    bool operator==(const SmokeCell&) const = default;
};

struct SmokeBaseline {
    std::string device_kind;  ///< cpu, gpu or other
    std::vector<SmokeCell> cells;
};

/// What is the same on every machine of a kind, of a cell: exact counters but for bytes that depend on how many compute units there
/// are; of libraries, whose versions differ, only what they found.
std::map<std::string, double> machine_independent_counters(const Cell& cell);

/// What of a run is kept as its baseline.
SmokeBaseline smoke_baseline(const Document& document);

/// A cell a line, so that changes can be read.
std::string smoke_text(const SmokeBaseline& baseline);

/// Throws Unavailable, naming `origin`, for a text that is no baseline.
SmokeBaseline read_smoke(const std::string& text, const std::string& origin);

/// How a run departs from its baseline.
struct SmokeResult {
    std::vector<std::string> regressions;  ///< a sentence each, with the cell's name
    std::vector<std::string> remarks;      ///< changes that nothing fails for
    std::size_t compared = 0;              ///< cells
    std::size_t timed = 0;                 ///< of them, with a ratio
};

/// By how much a cell may be slower beside the others of its scene than it was: times of one machine on another.
constexpr double smoke_tolerance = 5;

/// Hold `now` to `before`: verdicts, counters and hashes exactly; times as ratios to the median ratio of their scene, at
/// most `tolerance`, and 50 us at least. With `some`, cells that `now` lacks are no regression.
SmokeResult compare_smoke(const SmokeBaseline& before, const SmokeBaseline& now, double tolerance,
                          bool some);

/// results/baseline/smoke-<kind>.json in the sources that the program was built from.
std::filesystem::path smoke_path(const std::string& device_kind);

}  // namespace bvhbench
